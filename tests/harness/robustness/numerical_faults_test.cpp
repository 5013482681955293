// Filters with numerical failures: each failure is reported, and a filter that is of no more use is stopped.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/score/scoreboard.hpp"

namespace harness {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Stands still with one landmark, until a failure at its tenth scan.
class Failing final : public seif::Estimator {
 public:
  enum class How { nan_pose, nan_landmark, no_gaussian, not_definite };

  Failing(const seif::EstimatorSetup& setup, How how) : pose_(setup.start.mean), how_(how) {}

  void motion_update(const seif::Odometry&) override {}
  void measurement_update(const seif::Scan& scan, const seif::StageDone& done) override {
    is_broken_ = ++scans_ >= 10;
    if (is_broken_ && how_ == How::not_definite) throw seif::NumericalFailure("sparsification", scan.t);
    done(seif::Stage::measurement);
  }
  seif::Pose2 pose() const override {
    return is_broken_ && how_ == How::nan_pose ? seif::Pose2{nan, 0.0, 0.0} : pose_;
  }
  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override {
    return {{0, {6.0, is_broken_ && how_ == How::nan_landmark ? nan : 0.0}}, {1, {1.0, 2.0}}};
  }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId> landmarks) const override {
    if (is_broken_ && how_ == How::no_gaussian) return std::nullopt;
    return seif::MarginalCovariances{Eigen::Matrix3d::Identity(),
                                     {landmarks.size(), Eigen::Matrix2d::Identity()}};
  }

 private:
  seif::Pose2 pose_;
  How how_;
  bool is_broken_ = false;
  int scans_ = 0;
};

RunResult run_failing(Failing::How how, const std::filesystem::path& folder) {
  seif::Registry registry = test::test_registry();
  seif::EstimatorType type;
  type.name = "failing";
  type.make = [how](const seif::EstimatorSetup& setup, const seif::Options&) {
    return std::make_unique<Failing>(setup, how);
  };
  registry.add(std::move(type));
  worlds::World world = test::small_world();
  worlds::EstimatorChoice choice;
  choice.name = choice.type = "failing";
  world.estimators.push_back(choice);
  return test::run_live(world, folder, registry);
}

class NumericalFault : public testing::Test {
 protected:
  /// This filter is the last of three; the other ones continue.
  void run(Failing::How how) {
    result_ = run_failing(how, folder_ / "run");
    EXPECT_EQ(result_.summary.failures.at(0), "");
    EXPECT_EQ(result_.summary.failures.at(1), "");
    EXPECT_EQ(result_.summary.updates, 100);
    for (const char* table : {"failing.tum", "failing_steps.csv", "failing_map.csv"}) {
      const std::string text = test::read_file(folder_ / "run" / table);
      EXPECT_EQ(text.find("nan"), std::string::npos) << table;
    }
  }
  const std::string& failure() const { return result_.summary.failures.at(2); }

  TemporaryFolder folder_;
  RunResult result_;
};

TEST_F(NumericalFault, APoseThatIsNotFiniteIsTold) {
  run(Failing::How::nan_pose);
  EXPECT_EQ(failure(), "at 2 s: the pose is not finite any more");
  EXPECT_EQ(exit_code(result_), 1);
}

TEST_F(NumericalFault, ALandmarkThatIsNotFiniteIsTold) {
  run(Failing::How::nan_landmark);
  EXPECT_EQ(failure(), "at 20 s: 1 landmarks of its map are not finite");
  EXPECT_EQ(exit_code(result_), 1);
}

TEST_F(NumericalFault, AMatrixThatHasLostItsDefinitenessIsTold) {
  run(Failing::How::not_definite);
  EXPECT_NE(failure().find("sparsification at t = 2"), std::string::npos) << failure();
  EXPECT_NE(failure().find("not positive definite"), std::string::npos);
  EXPECT_NE(scoreboard(result_.summary).find("failing failed at 2 s"), std::string::npos);
  EXPECT_EQ(exit_code(result_), 1);
}

TEST_F(NumericalFault, ABeliefThatIsNoneIsCountedAndTold) {
  run(Failing::How::no_gaussian);
  const EstimatorScore& score = result_.summary.score.estimators.at(2);
  EXPECT_EQ(score.improper_beliefs, 4);  // at 5, 10, 15 and 20 s
  EXPECT_EQ(score.improper_t, 5.0);
  EXPECT_NE(scoreboard(result_.summary).find("failing had no positive definite belief at 4 scoring times"),
            std::string::npos);
  EXPECT_NE(test::read_file(folder_ / "run" / "summary.json").find("\"improper_since_s\": 5.0"),
            std::string::npos);
}

}  // namespace
}  // namespace harness
