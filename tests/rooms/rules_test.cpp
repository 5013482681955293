// Each rule finds the source that breaks it, and accepts the one that does not.
#include "rules.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rooms {
namespace {

Findings check(const std::string& path, const std::string& text) {
  return check_source(parse_source({path, text}));
}

Findings check_include(const std::string& path, const std::string& include) {
  return check(path, "#pragma once\n#include " + include + "\n");
}

TEST(Arrows, MayBeFollowed) {
  EXPECT_EQ(check_include("seif/dense/ekf.cpp", R"("seif/models.hpp")"), no_findings);
  EXPECT_EQ(check_include("worlds/load.cpp", R"("worlds/world.hpp")"), no_findings);
  EXPECT_EQ(check_include("sensors/wheel_encoders.hpp", R"("seif/types.hpp")"), no_findings);
  EXPECT_EQ(check_include("sim/vehicle.hpp", R"("worlds/world.hpp")"), no_findings);
  EXPECT_EQ(check_include("sim/render/scene.cpp", R"("sim/render/scene.hpp")"), no_findings);
  for (const char* room : {"seif", "worlds", "sensors", "sim", "sim/render", "harness", "harness/peers"}) {
    EXPECT_EQ(check_include("harness/run/run.cpp", std::string("\"") + room + "/a.hpp\""), no_findings)
        << room;
  }
  EXPECT_EQ(check_include("tests/seif/dense/ekf_test.cpp", R"("seif/dense/ekf.hpp")"), no_findings);
  EXPECT_EQ(check_include("tests/seif/dense/ekf_test.cpp", R"("oracle.hpp")"), no_findings);
  EXPECT_EQ(check_include("tests/render/text_test.cpp", R"("sim/render/scene.hpp")"), no_findings);
}

TEST(Arrows, MayNotBeCrossed) {
  const std::vector<std::pair<std::string, std::string>> crossings = {
      {"seif/dense/ekf.cpp", "worlds/world.hpp"},
      {"seif/dense/ekf.cpp", "sim/simulator.hpp"},
      {"seif/dense/ekf.cpp", "sensors/wheel_encoders.hpp"},
      {"seif/dense/ekf.cpp", "harness/stream/stream.hpp"},
      {"worlds/load.cpp", "seif/types.hpp"},
      {"worlds/load.cpp", "harness/stream/stream.hpp"},
      {"sensors/wheel_encoders.cpp", "seif/estimator.hpp"},
      {"sensors/wheel_encoders.cpp", "sim/simulator.hpp"},
      {"sensors/wheel_encoders.cpp", "worlds/world.hpp"},
      {"sim/simulator.cpp", "seif/types.hpp"},
      {"sim/simulator.cpp", "sensors/landmark_sensor.hpp"},
      {"sim/simulator.cpp", "harness/stream/stream.hpp"},
      {"sim/render/scene.cpp", "sim/simulator.hpp"},
      {"sim/render/scene.cpp", "worlds/world.hpp"},
      {"tests/seif/dense/ekf_test.cpp", "sim/simulator.hpp"},
      {"tests/render/text_test.cpp", "sim/simulator.hpp"},
      {"tests/sim/simulator_test.cpp", "tests/seif/oracle.hpp"},
      {"tests/sim/simulator_test.cpp", "../seif/oracle.hpp"},
      {"harness/run/run.cpp", "tests/seif/oracle.hpp"},
      {"harness/run/run.cpp", "stream.hpp"},
      {"seif/dense/ekf.cpp", "seif/../sim/simulator.hpp"},
      {"docs/example.cpp", "seif/estimator.hpp"},
      {"harness/peers/mrpt_filter/mrpt_filter.cpp", "worlds/world.hpp"},
      {"harness/peers/mrpt_filter/mrpt_filter.cpp", "harness/stream/stream.hpp"},
  };
  for (const auto& [path, include] : crossings) {
    const Findings expected = {path + ":2: may not include " + include};
    EXPECT_EQ(check_include(path, "\"" + include + "\""), expected);
  }
}

TEST(Arrows, HoldInAngleBracketsToo) {
  const Findings expected = {"worlds/load.cpp:2: may not include seif/types.hpp"};
  EXPECT_EQ(check_include("worlds/load.cpp", "<seif/types.hpp>"), expected);
}

TEST(Arrows, NeedANameToFollow) {
  const Findings expected = {"harness/run/run.cpp:2: an include that names no file"};
  EXPECT_EQ(check_include("harness/run/run.cpp", "HEADER"), expected);
}

TEST(Libraries, MayBeUsedAtHome) {
  EXPECT_EQ(check("sim/vehicle.hpp", "#pragma once\n#include <btBulletDynamicsCommon.h>\nbtVector3 p;\n"),
            no_findings);
  EXPECT_EQ(check_include("sim/render/canvas.cpp", "<GL/osmesa.h>"), no_findings);
  EXPECT_EQ(check("sim/render/font.cpp", "#include <ft2build.h>\nFT_Library library;\n"), no_findings);
  EXPECT_EQ(check("sim/render/png.cpp", "#include <png.h>\npng_image image;\n"), no_findings);
  EXPECT_EQ(check("worlds/load.cpp", "#include <yaml-cpp/yaml.h>\nYAML::Node node;\n"), no_findings);
  EXPECT_EQ(check_include("harness/score/summary.cpp", "<nlohmann/json.hpp>"), no_findings);
  EXPECT_EQ(check_include("harness/commands/main.cpp", "<CLI/CLI.hpp>"), no_findings);
  EXPECT_EQ(check_include("harness/estimators/full_slam.cpp", "<ceres/problem.h>"), no_findings);
  EXPECT_EQ(check("harness/peers/mrpt_filter/mrpt_filter.cpp",
                  "#include <mrpt/poses/CPose2D.h>\nmrpt::poses::CPose2D pose;\n"),
            no_findings);
  EXPECT_EQ(check_include("harness/statistics/statistics.cpp", "<boost/math/distributions/students_t.hpp>"),
            no_findings);
}

TEST(Libraries, StayAtHome) {
  const std::vector<std::pair<std::string, std::string>> strays = {
      {"sim/simulator.hpp", "btBulletDynamicsCommon.h"},
      {"sim/kinematic_simulator.cpp", "btBulletDynamicsCommon.h"},
      {"sim/render/scene.cpp", "LinearMath/btVector3.h"},
      {"harness/run/run.cpp", "BulletCollision/CollisionShapes/btBoxShape.h"},
      {"tests/sim/simulator_test.cpp", "bullet/btBulletCollisionCommon.h"},
      {"sim/simulator.cpp", "GL/osmesa.h"},
      {"harness/film/film.cpp", "GL/gl.h"},
      {"harness/film/film.cpp", "png.h"},
      {"sim/simulator.cpp", "ft2build.h"},
      {"harness/figures/plot.cpp", "freetype/freetype.h"},
      {"worlds/load.hpp", "yaml-cpp/yaml.h"},
      {"harness/commands/replay.cpp", "yaml-cpp/yaml.h"},
      {"harness/score/summary.hpp", "nlohmann/json.hpp"},
      {"worlds/schema.hpp", "nlohmann/json_fwd.hpp"},
      {"sim/simulator.cpp", "CLI/CLI.hpp"},
      {"harness/estimators/full_slam.hpp", "ceres/problem.h"},
      {"harness/statistics/statistics.hpp", "boost/math/distributions/students_t.hpp"},
      {"sim/simulator.cpp", "ceres/solver.h"},
      {"harness/estimators/mrpt_ekf.cpp", "mrpt/poses/CPose2D.h"},
      {"harness/peers/mrpt_filter/mrpt_filter.hpp", "mrpt/poses/CPose2D.h"},
  };
  for (const auto& [path, include] : strays) {
    const Findings findings = check_include(path, "<" + include + ">");
    ASSERT_EQ(findings.size(), 1U) << path << " " << include;
    EXPECT_TRUE(findings.front().ends_with(" does not belong here: " + include)) << findings.front();
  }
}

TEST(Libraries, AreNotNamedAbroadEither) {
  const std::vector<std::pair<std::string, std::string>> names = {
      {"sim/simulator.hpp", "btRigidBody"},        {"harness/film/film.cpp", "OSMesaContext"},
      {"harness/film/film.cpp", "GL_RGB"},         {"harness/film/film.cpp", "png_image"},
      {"tests/render/text_test.cpp", "FT_Face"},   {"worlds/load.hpp", "YAML"},
      {"harness/estimators/mrpt_ekf.hpp", "mrpt"}, {"worlds/schema.hpp", "nlohmann"}};
  for (const auto& [path, name] : names) {
    const Findings findings = check(path, "#pragma once\nclass " + name + ";\n");
    ASSERT_EQ(findings.size(), 1U) << path;
    EXPECT_TRUE(findings.front().ends_with(" does not belong here: " + name)) << findings.front();
  }
}

TEST(Libraries, AreNotHandedOnThroughHeaders) {
  const Source inner = parse_source({"sim/vehicle.hpp", "#include <btBulletDynamicsCommon.h>\n"});
  const Source outer = parse_source({"sim/ground.hpp", "#include \"sim/vehicle.hpp\"\n"});
  const Source user = parse_source({"harness/run/run.cpp", "#include \"sim/ground.hpp\"\n"});
  EXPECT_EQ(check_reach({inner, outer}), no_findings);
  const Findings expected = {"harness/run/run.cpp:1: gets Bullet from sim/vehicle.hpp"};
  EXPECT_EQ(check_reach({inner, outer, user}), expected);
}

TEST(Libraries, AreNotHandedOnBetweenTests) {
  const Source inner = parse_source({"sim/vehicle.hpp", "#include <btBulletDynamicsCommon.h>\n"});
  const Source driver = parse_source({"tests/sim/driver.hpp", "#include \"sim/vehicle.hpp\"\n"});
  const Source test = parse_source({"tests/sim/motion_test.cpp", "#include \"driver.hpp\"\n"});
  const Findings expected = {"tests/sim/driver.hpp:1: gets Bullet from sim/vehicle.hpp",
                             "tests/sim/motion_test.cpp:1: gets Bullet from sim/vehicle.hpp"};
  EXPECT_EQ(check_reach({inner, driver, test}), expected);
}

TEST(Libraries, AreFollowedThroughCircles) {
  const Source a = parse_source({"harness/a.hpp", "#include \"harness/b.hpp\"\n"});
  const Source b = parse_source({"harness/b.hpp", "#include \"harness/a.hpp\"\n"});
  EXPECT_EQ(check_reach({a, b}), no_findings);
}

TEST(Scorer, KnowsNoEstimatorAndNoSimulator) {
  const Source types = parse_source({"seif/types.hpp", ""});
  const Source ekf = parse_source({"seif/dense/ekf.hpp", "#include \"seif/types.hpp\"\n"});
  const Source live = parse_source({"harness/run/live.hpp", "#include \"seif/dense/ekf.hpp\"\n"});
  EXPECT_EQ(check_reach({types, parse_source({"harness/score/score.hpp", "#include \"seif/types.hpp\"\n"})}),
            no_findings);
  const Findings expected = {"harness/score/score.cpp:1: the scorer may not know seif/dense/ekf.hpp"};
  EXPECT_EQ(check_reach({types, ekf, live,
                         parse_source({"harness/score/score.cpp", "#include \"harness/run/live.hpp\"\n"})}),
            expected);
}

TEST(Purity, LetsEigenAndTheStandardLibraryIn) {
  for (const char* room : {"seif/dense/ekf.cpp", "sensors/wheel_encoders.cpp"}) {
    EXPECT_EQ(check(room, "#include <Eigen/Cholesky>\n#include <cmath>\n#include <random>\n"), no_findings);
  }
}

TEST(Purity, KeepsLibrariesClocksFilesAndOutputOut) {
  for (const std::string path : {"seif/dense/ekf.cpp", "sensors/wheel_encoders.cpp"}) {
    for (const std::string header : {"fmt/format.h", "sys/time.h", "unistd.h", "gtest/gtest.h", "chrono",
                                     "ctime", "iostream", "fstream", "thread", "cstdio"}) {
      const Findings expected = {path + ":2: may not include <" + header + ">"};
      EXPECT_EQ(check_include(path, "<" + header + ">"), expected);
    }
    for (const std::string word : {"std::chrono", "std::cout", "std::printf"}) {
      EXPECT_EQ(check(path, "auto a = " + word + ";\n").size(), 1U) << word;
    }
  }
  EXPECT_EQ(check_include("harness/run/run.cpp", "<chrono>"), no_findings);
}

TEST(Determinism, AllowsSeededEngines) {
  EXPECT_EQ(check("worlds/generate.cpp",
                  "// no random_device\nstd::mt19937_64 a(seed); brand(); time(t); run_time(0);\n"),
            no_findings);
}

TEST(Determinism, ForbidsChanceAndTimeThatNobodyHandedOver) {
  for (const std::string code :
       {"std::random_device device;", "srand(1);", "int a = rand();", "int a = std::rand ();",
        "auto a = time(nullptr);", "auto a = std::time(NULL);", "auto a = time(0);"}) {
    for (const std::string path : {"harness/run/run.cpp", "tests/sim/simulator_test.cpp"}) {
      const Findings findings = check(path, "\n" + code + "\n");
      ASSERT_EQ(findings.size(), 1U) << code;
      EXPECT_TRUE(findings.front().starts_with(path + ":2: ")) << findings.front();
      EXPECT_TRUE(findings.front().ends_with(" breaks determinism")) << findings.front();
    }
  }
}

TEST(Headers, AreGuarded) {
  EXPECT_EQ(check("seif/a.hpp", "// What it is.\n#pragma once\nint a();\n"), no_findings);
  EXPECT_EQ(check("seif/a.cpp", "int a();\n"), no_findings);
  const Findings expected = {"seif/a.hpp:1: a header without #pragma once"};
  EXPECT_EQ(check("seif/a.hpp", "// #pragma once\nint a();\n"), expected);
}

TEST(LinkLines, MaySayWhatTheArchitectureSays) {
  EXPECT_EQ(check_cmake_lists(
                {"sim/CMakeLists.txt",
                 "add_library(sim STATIC a.cpp)\n"
                 "target_link_libraries(sim PUBLIC worlds PRIVATE PkgConfig::bullet seifbed_flags)\n"}),
            no_findings);
  EXPECT_EQ(check_cmake_lists({"sim/render/CMakeLists.txt",
                               "add_library(render STATIC a.cpp)\n"
                               "target_link_libraries(render PUBLIC Eigen3::Eigen PRIVATE OSMesa::headers "
                               "Freetype::Freetype PNG::PNG ${CMAKE_DL_LIBS} seifbed_flags)\n"}),
            no_findings);
  EXPECT_EQ(
      check_cmake_lists({"harness/peers/mrpt_filter/CMakeLists.txt",
                         "add_library(mrpt_filter SHARED a.cpp)\n"
                         "target_link_libraries(mrpt_filter PRIVATE mrpt::slam seifbed_portable_flags)\n"}),
      no_findings);
  EXPECT_EQ(check_cmake_lists({"harness/peers/CMakeLists.txt",
                               "find_package(mrpt-slam QUIET)\n"
                               "if(mrpt-slam_FOUND)\n"
                               "  add_library(peers MODULE a.cpp)\n"
                               "  target_link_libraries(peers PRIVATE seif mrpt_filter seifbed_flags)\n"
                               "endif()\n"}),
            no_findings);
  EXPECT_EQ(
      check_cmake_lists({"harness/CMakeLists.txt",
                         "add_library(harness STATIC a.cpp)\n"
                         "target_link_libraries(harness PUBLIC seif worlds sensors sim PRIVATE fmt::fmt)\n"
                         "add_executable(seifbed main.cpp)\n"
                         "target_link_libraries(seifbed PRIVATE harness CLI11::CLI11)\n"}),
      no_findings);
}

TEST(LinkLines, MayNotGoAgainstTheArrows) {
  const std::vector<std::vector<std::string>> wrong = {
      {"seif", "PUBLIC worlds", "worlds publicly"},
      {"seif", "PUBLIC Eigen3::Eigen PRIVATE fmt::fmt", "fmt::fmt privately"},
      {"worlds", "PUBLIC Eigen3::Eigen yaml-cpp", "yaml-cpp publicly"},
      {"worlds", "PRIVATE seif", "seif privately"},
      {"sensors", "PUBLIC seif sim", "sim publicly"},
      {"sim", "worlds PkgConfig::bullet", "PkgConfig::bullet publicly"},
      {"harness", "PRIVATE peers", "peers privately"},
      {"harness", "PRIVATE mrpt::slam", "mrpt::slam privately"},
      {"sim", "PUBLIC worlds PRIVATE OSMesa::headers", "OSMesa::headers privately"},
      {"sim", "PUBLIC worlds PRIVATE Freetype::Freetype", "Freetype::Freetype privately"},
      {"harness", "PUBLIC sim PRIVATE PNG::PNG", "PNG::PNG privately"},
      {"sim", "PUBLIC worlds PRIVATE seif", "seif privately"},
      {"harness", "PUBLIC sim nlohmann_json::nlohmann_json", "nlohmann_json::nlohmann_json publicly"},
      {"harness", "PUBLIC sim PRIVATE PkgConfig::bullet", "PkgConfig::bullet privately"},
  };
  for (const auto& line : wrong) {
    const std::string path = line[0] + "/CMakeLists.txt";
    const std::string text = "add_library(" + line[0] + " STATIC a.cpp)\n" +  //
                             "target_link_libraries(" + line[0] + " " + line[1] + ")\n";
    const Findings expected = {path + ":2: may not link " + line[2]};
    EXPECT_EQ(check_cmake_lists({path, text}), expected);
  }
}

TEST(LinkLines, CannotBeGoneRound) {
  const Findings detour = {"seif/CMakeLists.txt:2: target_include_directories goes round the link line"};
  EXPECT_EQ(check_cmake_lists(
                {"seif/CMakeLists.txt",
                 "add_library(seif a.cpp)\ntarget_include_directories(seif PRIVATE /usr/include/bullet)"}),
            detour);
}

TEST(LinkLines, BelongToTheOneTargetOfTheRoom) {
  const Findings misnamed = {"seif/CMakeLists.txt:1: the target of this room is seif"};
  EXPECT_EQ(check_cmake_lists({"seif/CMakeLists.txt", "add_library(filters a.cpp)"}), misnamed);
  const Findings second = {"seif/CMakeLists.txt:1: a room makes one library"};
  EXPECT_EQ(
      check_cmake_lists({"seif/CMakeLists.txt", "add_library(seif a.cpp)\nadd_library(seif OBJECT b.cpp)"}),
      second);
}

TEST(Paths, AreThoseOfTheArchitecture) {
  EXPECT_EQ(
      check_paths({".gitignore", ".ci/run", "README.md", "LICENSE", "seifbed", "test", "seif/dense/ekf.cpp",
                   "docs/log_format.md", "CMakeLists.txt", "CMakePresets.json", "worlds/courtyard.yaml"}),
      no_findings);
  const Findings expected = {"scripts: not at the top"};
  EXPECT_EQ(check_paths({"scripts/a.sh", "scripts/b.sh"}), expected);
}

TEST(Paths, SayWhatTheyAreFor) {
  const Findings expected = {"harness/utils.hpp: 'utils.hpp' does not say what it is for",
                             "seif/common/a.hpp: 'common' does not say what it is for"};
  EXPECT_EQ(check_paths({"seif/common/a.hpp", "harness/utils.hpp"}), expected);
}

}  // namespace
}  // namespace rooms
