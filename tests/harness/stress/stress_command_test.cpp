#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;

TEST(StressCommand, PrintsJsonAndLeavesTablesAndPlots) {
  const TemporaryFolder folder;
  const Called called =
      call(folder, "stress --landmarks 200,100,100 --estimators seif --updates 10 --json --out out");
  ASSERT_EQ(called.exit_code, 0) << called.errors;
  const nlohmann::json json = nlohmann::json::parse(called.output);
  ASSERT_EQ(json["rows"].size(), 2U);
  EXPECT_EQ(json["rows"][0]["landmarks"], 100);
  EXPECT_EQ(called.output, test::read_file(folder / "out/stress.json"));
  EXPECT_NE(test::read_file(folder / "out/stress.txt").find("warm start"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/time.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/time.svg"));
}

/// What `stress --json` tells of the estimators in a world of a hundred landmarks; null if the program fails.
nlohmann::json estimators_with(const std::string& options) {
  const TemporaryFolder folder;
  const Called called = call(folder, "stress --landmarks 100 --updates 10 --json " + options);
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  return called.exit_code == 0 ? nlohmann::json::parse(called.output)["rows"][0]["estimators"] : nullptr;
}

TEST(StressCommand, TakesOptionsOfEstimators) {
  nlohmann::json estimators = estimators_with(
      "--estimators seif --pattern ring --set 'estimators.tree={type: seif, mean_recovery: tree}'");
  EXPECT_EQ(estimators["seif"]["landmarks"], 100);
  EXPECT_EQ(estimators["tree"]["landmarks"], 100);
}

TEST(StressCommand, AFilterIsLeftOutOfWorldsAboveItsLimitAndTheReportSaysSo) {
  const TemporaryFolder folder;
  const Called called = call(folder,
                             "stress --landmarks 100,150 --estimators seif,ekf --limit ekf=100 --updates 10 "
                             "--json --out out");
  ASSERT_EQ(called.exit_code, 0) << called.errors;
  const nlohmann::json rows = nlohmann::json::parse(called.output)["rows"];
  EXPECT_TRUE(rows[0]["estimators"]["ekf"]["skipped"].is_null());
  EXPECT_TRUE(rows[1]["estimators"]["ekf"]["skipped"].is_string());
  EXPECT_TRUE(rows[1]["estimators"]["seif"]["skipped"].is_null());
  ASSERT_EQ(call(folder, "report out").exit_code, 0);
  EXPECT_NE(test::read_file(folder / "out/report.html")
                .find("150, ekf: " + rows[1]["estimators"]["ekf"]["skipped"].get<std::string>()),
            std::string::npos);
}

TEST(StressCommand, RefusesWhatItCannotDo) {
  const TemporaryFolder folder;
  EXPECT_EQ(call(folder, "stress --landmarks 100 --limit ekf").exit_code, 2);
  EXPECT_EQ(call(folder, "stress --landmarks 100 --updates 10 --places 11").exit_code, 2);
  EXPECT_EQ(call(folder, "stress --landmarks 100 --limit ekf=many").exit_code, 2);
  EXPECT_EQ(call(folder, "stress --landmarks 100 --pattern spiral").exit_code, 2);
}

TEST(StressCommand, AnUnknownEstimatorIsNamedAndNothingIsWritten) {
  const TemporaryFolder folder;
  const auto errors_of = [&](const std::string& options) {
    const Called called = call(folder, "stress --landmarks 100 --out out " + options);
    EXPECT_EQ(called.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    return called.errors;
  };
  EXPECT_NE(
      errors_of("--estimators sef").find("--estimators: there is no estimator 'sef' (did you mean 'seif'?)"),
      std::string::npos);
  EXPECT_NE(errors_of("--estimators seif --reference bath")
                .find("--reference: there is no estimator 'bath' (did you mean 'batch'?)"),
            std::string::npos);
  EXPECT_NE(errors_of("--estimators seif --limit efk=5")
                .find("--limit: there is no estimator 'efk' (did you mean 'ekf'?)"),
            std::string::npos);
}

TEST(StressCommand, ANameThatGetsATypeIsAnEstimator) {
  nlohmann::json estimators = estimators_with("--estimators mine --set estimators.mine.type=seif");
  EXPECT_EQ(estimators["mine"]["landmarks"], 100);
}

}  // namespace
}  // namespace harness
