#include "harness/estimators/plugins.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "harness/command_call.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;

std::string plugin(const std::string& kind) {
  return std::string(SEIFBED_TEST_PLUGINS) + "/plugin_" + kind + ".so";
}

std::string error_of(const std::string& library) {
  try {
    plugin_estimators(library);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

constexpr const char* tiny_world =
    "name: tiny\n"
    "duration_s: 2\n"
    "landmarks: {generators: [{type: uniform, count: 20}]}\n"
    "estimators: {ekf: {}, plugged_in: {}}\n";

TEST(Plugins, BringEstimatorsWithOptions) {
  const seif::Registry& registry = plugin_estimators(plugin("good"));
  ASSERT_EQ(registry.types().size(), 1U);
  EXPECT_EQ(registry.types().front().options.front().key, "throw_after");
  EXPECT_EQ(&plugin_estimators(plugin("good")), &registry) << "it was loaded twice";
}

TEST(Plugins, ThatAreWrongAreRefusedWithAReason) {
  EXPECT_NE(error_of("/nowhere/libmine.so").find("there is no such file"), std::string::npos);
  EXPECT_NE(error_of(std::string(SEIFBED_TEST_PLUGINS) + "/CTestTestfile.cmake").find("cannot be loaded"),
            std::string::npos);
  EXPECT_NE(error_of(plugin("without_function")).find("does not export seif_plugin()"), std::string::npos);
  EXPECT_NE(error_of(plugin("other_interface")).find("is for version 3 of the interface"), std::string::npos);
  EXPECT_NE(error_of(plugin("other_alignment")).find("aligns matrices to 128 and"), std::string::npos);
  EXPECT_NE(error_of(plugin("adds_nothing")).find("adds no estimator"), std::string::npos);
  EXPECT_NE(error_of(plugin("throws")).find("the moon is not full"), std::string::npos);
  EXPECT_NE(error_of(plugin("throws_a_number")).find("no std::exception"), std::string::npos);
}

TEST(Plugins, MustBeBuiltLikeTheProgram) {
  EXPECT_EQ(mismatch({}), "");
  seif::PluginBuild build;
  build.eigen += 1;
  EXPECT_NE(mismatch(build).find("version 30401 of Eigen"), std::string::npos) << mismatch(build);
  build = {};
  build.string_bytes += 8;
  EXPECT_NE(mismatch(build).find("standard library"), std::string::npos);
}

TEST(Plugins, CannotTakeAName) {
  seif::Registry registry = test::test_registry();
  EXPECT_THROW(add_plugin(plugin("takes_a_name"), registry), BadInput);
}

TEST(PluginCommand, AnOptionLoadsAPluginIntoEveryCommand) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", tiny_world);
  const std::string with = "--plugin " + plugin("good") + " ";
  EXPECT_EQ(call(folder, "validate world.yaml").exit_code, 2);
  for (const char* command :
       {"validate world.yaml", "run world.yaml --out run", "replay run --out again", "score run",
        "compare world.yaml --seeds 1..2 --out compared", "sweep world.yaml --seeds 1..2 --out swept",
        "film run -o film.png --from 1 --to 1.1", "report run",
        "stress --landmarks 100 --updates 10 --estimators plugged_in --out stress"}) {
    const Called called = call(folder, with + command);
    EXPECT_EQ(called.exit_code, 0) << command << ": " << called.errors;
  }
  EXPECT_NE(call(folder, with + "estimators").output.find("plugged_in"), std::string::npos);
  EXPECT_NE(call(folder, with + "schema").output.find("throw_after"), std::string::npos);
}

TEST(PluginCommand, TheEnvironmentDoesSo) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", tiny_world);
  EXPECT_EQ(call(folder, "validate world.yaml", "SEIFBED_PLUGINS=" + plugin("good")).exit_code, 0);
  const Called both = call(folder, "--plugin " + plugin("good") + " validate world.yaml",
                           "SEIFBED_PLUGINS=" + plugin("good"));
  EXPECT_EQ(both.exit_code, 0) << both.errors;
  const Called wrong = call(folder, "validate world.yaml", "SEIFBED_PLUGINS=/nowhere.so");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.errors.find("SEIFBED_PLUGINS: /nowhere.so: there is no such file"), std::string::npos)
      << wrong.errors;
}

/// A world whose estimator is in a library, in `keys`.
void write_world_with(const TemporaryFolder& folder, const std::string& keys) {
  test::write_file(folder / "world.yaml",
                   "name: tiny\nduration_s: 2\nlandmarks: {generators: [{type: uniform, count: 20}]}\n"
                   "estimators:\n  mine: {" +
                       keys + "}\n");
}

TEST(PluginCommand, AWorldNamesALibraryRelativeToItself) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(plugin("good"), folder / "libmine.so");
  write_world_with(folder, "library: libmine.so, throw_after: 3");
  const Called called = call(folder, "run world.yaml --out run");
  EXPECT_EQ(called.exit_code, 1) << called.errors;
  EXPECT_NE(called.output.find("it threw something that is no std::exception"), std::string::npos)
      << called.errors;
  write_world_with(folder, "library: libmine.so, type: plugged_in");
  const Called elsewhere = call(folder, "compare world.yaml --seeds 1..2 --out deep/er");
  EXPECT_EQ(elsewhere.exit_code, 0) << elsewhere.errors;
  EXPECT_EQ(call(folder, "run world.yaml --out good").exit_code, 0);
  EXPECT_EQ(call(folder, "replay good --out again").exit_code, 0)
      << "the run's folder knows where the library is";
}

TEST(PluginCommand, AWorldWithAWrongLibraryIsRefusedAtItsPlace) {
  const TemporaryFolder folder;
  write_world_with(folder, "library: nowhere.so, gain: 2");
  const Called missing = call(folder, "validate world.yaml");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.errors.find("world.yaml:5:19: "), std::string::npos) << missing.errors;
  EXPECT_NE(missing.errors.find("there is no such file"), std::string::npos) << missing.errors;
  EXPECT_EQ(missing.errors.find("gain"), std::string::npos) << missing.errors;

  write_world_with(folder, "library: " + plugin("good") + ", gain: 2");
  const Called unknown = call(folder, "validate world.yaml");
  EXPECT_NE(unknown.errors.find("unknown key 'gain'"), std::string::npos) << unknown.errors;

  write_world_with(folder, "library: " + plugin("good") + ", type: ekf");
  const Called type = call(folder, "validate world.yaml");
  EXPECT_NE(type.errors.find("'type' must be one of plugged_in, not 'ekf'"), std::string::npos)
      << type.errors;
}

TEST(PluginCommand, AnEstimatorThatCannotBeMadeIsAProblemOfTheWorld) {
  const TemporaryFolder folder;
  for (const auto& [kind, reason] : {std::pair("throws_when_made", "its constructor throws something"),
                                     std::pair("makes_nothing", "its plug-in makes no estimator")}) {
    write_world_with(folder, "library: " + plugin(kind));
    const Called called = call(folder, "run world.yaml");
    EXPECT_EQ(called.exit_code, 2) << kind;
    EXPECT_NE(called.errors.find(reason), std::string::npos) << called.errors;
  }
}

TEST(PluginCommand, TheOptionStandsBeforeTheCommand) {
  const TemporaryFolder folder;
  const Called called = call(folder, "run world.yaml --plugin libmine.so");
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_NE(called.errors.find("it stands before the command: seifbed --plugin"), std::string::npos)
      << called.errors;
}

}  // namespace
}  // namespace harness
