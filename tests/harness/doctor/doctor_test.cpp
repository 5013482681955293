#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "harness/command_call.hpp"
#include "harness/doctor/diagnosis.hpp"
#include "harness/doctor/library_versions.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;

TEST(Finding, IsBadWithTheReasonWhereLookingThrows) {
  const Finding good = finding("water", [] { return "wet"; });
  EXPECT_TRUE(good.is_good);
  EXPECT_EQ(good.says, "wet");
  const Finding bad = finding("fire", []() -> std::string { throw std::runtime_error("is out"); });
  EXPECT_FALSE(bad.is_good);
  EXPECT_EQ(bad.says, "is out");
}

TEST(Diagnosis, IsWellIfEveryFindingIsGood) {
  Diagnosis diagnosis;
  diagnosis.machine = {{"cores", true, "2"}};
  EXPECT_TRUE(is_well(diagnosis));
  EXPECT_NE(diagnosis_board(diagnosis).find("All is well"), std::string::npos);
  diagnosis.self_test = {{"physics", false, "the robot fell over"}};
  EXPECT_FALSE(is_well(diagnosis));
  EXPECT_NE(diagnosis_board(diagnosis).find("BAD   physics  the robot fell over\n1 of these"),
            std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(diagnosis))["self_test"]["physics"]["good"], false);
}

TEST(LibraryVersions, AreKnown) {
  EXPECT_GE(library_versions().size(), 10U);
  for (const LibraryVersion& library : library_versions()) {
    EXPECT_NE(library.version.find_first_of("0123456789"), std::string_view::npos) << library.name;
  }
}

TEST(Doctor, FindsAllWellWhereEverythingIsInstalledInTenSeconds) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "temporary");
  const auto begin = std::chrono::steady_clock::now();
  const Called called = call(folder, "doctor --json", "TMPDIR=$PWD/temporary");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(called.exit_code, 0) << called.output;
#ifdef NDEBUG  // sanitizers take time, and print what they allow
  EXPECT_EQ(called.errors, "");
  EXPECT_LT(took.count(), 10.0);
#endif
  const nlohmann::json json = nlohmann::json::parse(called.output);
  EXPECT_EQ(json["well"], true);
  for (const char* part : {"physics", "sensing", "estimation", "rendering"})
    EXPECT_EQ(json["self_test"][part]["good"], true) << part;
  for (const char* part : {"cores", "memory", "OSMesa", "ffmpeg", "H.264 encoder", "VP9 encoder",
                           "GIF encoder", "gnuplot", "Chart.js", "three.js"})
    EXPECT_EQ(json["machine"][part]["good"], true) << part;
  EXPECT_TRUE(std::filesystem::is_empty(folder / "temporary")) << "it leaves something behind";
}

TEST(Doctor, SaysWhatToInstallForWhatIsMissing) {
  const TemporaryFolder folder;
  const Called called = call(folder, "doctor", "PATH=/nowhere");
  EXPECT_EQ(called.exit_code, 1);
  EXPECT_NE(called.output.find("missing: install ffmpeg (Debian)"), std::string::npos) << called.output;
  EXPECT_NE(called.output.find("missing: install gnuplot-nox (Debian)"), std::string::npos);
  EXPECT_NE(called.output.find("2 of these need attention."), std::string::npos);
}

TEST(Doctor, SaysWhereNothingCanBeWritten) {
  const TemporaryFolder folder;
  const Called called = call(folder, "doctor", "TMPDIR=$PWD/nothing");
  EXPECT_EQ(called.exit_code, 1);
  EXPECT_NE(called.output.find("BAD   temporary folder"), std::string::npos) << called.output;
}

}  // namespace
}  // namespace harness
