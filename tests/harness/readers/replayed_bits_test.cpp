// A recorded log holds one triangle of each covariance. What the estimators were given must be what is
// written, to the last bit, so that a replay of the record is the run again. With full random covariances, in
// all formats that can hold them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "harness/fixtures.hpp"
#include "harness/readers/open_log.hpp"
#include "harness/run/prepared_run.hpp"
#include "logs.hpp"

namespace harness {
namespace {

using namespace test;

constexpr int poses = 40;     // [-]
constexpr int landmarks = 7;  // [-] all seen from every pose

/// Numbers for logs: random triangles that are well conditioned, but far from diagonal.
class RandomLog {
 public:
  /// A row of a square root R.
  template <int Size>
  Eigen::Matrix<double, Size, Size> root(double scale) {
    Eigen::Matrix<double, Size, Size> R = Eigen::Matrix<double, Size, Size>::Zero();
    for (int i = 0; i < Size; ++i) {
      for (int j = i; j < Size; ++j) R(i, j) = scale * (i == j ? 1.0 + std::abs(unit()) : unit());
    }
    return R;
  }

  template <class Matrix>
  static std::string triangle(const Matrix& matrix, char separator) {
    std::string text;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = i; j < matrix.cols(); ++j) text += fmt::format("{}{}", separator, matrix(i, j));
    }
    return text;
  }

  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

 private:
  std::mt19937_64 random_{11};
};

/// The true motion of all logs, and where a landmark is seen from pose `k`.
constexpr seif::Pose2 T_step{0.5, 0.01, 0.16};
Eigen::Vector2d seen(int k, int landmark) {
  seif::Pose2 pose;
  for (int i = 0; i < k; ++i) pose = pose * T_step;
  return inverse(pose) * Eigen::Vector2d(2.0 * landmark - 6.0, landmark % 2 == 0 ? -1.0 : 7.0);
}

/// In the format of g2o, or of iSAM, which gives square roots of the information.
Files graph_log(bool is_isam) {
  RandomLog random;
  std::string text;
  for (int k = 0; k < poses; ++k) {
    if (k > 0) {
      const Eigen::Matrix3d R = random.root<3>(20.0);
      text += fmt::format("{} {} {} {} {} {}{}\n", is_isam ? "ODOMETRY" : "EDGE_SE2", k - 1, k,
                          T_step.x + 0.01 * random.unit(), T_step.y, T_step.theta + 0.01 * random.unit(),
                          random.triangle(is_isam ? R : Eigen::Matrix3d(R.transpose() * R), ' '));
    }
    for (int landmark = 0; landmark < landmarks; ++landmark) {
      const Eigen::Matrix2d R = random.root<2>(10.0);
      const Eigen::Vector2d p = seen(k, landmark);
      text += fmt::format("{} {} {} {} {}{}\n", is_isam ? "LANDMARK" : "EDGE_SE2_XY", k, 1000 + landmark,
                          p.x() + 0.01 * random.unit(), p.y() + 0.01 * random.unit(),
                          random.triangle(is_isam ? R : Eigen::Matrix2d(R.transpose() * R), ' '));
    }
  }
  return {{"graph.txt", text}};
}

/// In our own format, without symmetric numbers anywhere.
Files own_log() {
  RandomLog random;
  std::string odometry = "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt\n";
  std::string observations = "t,landmark,range,bearing,cov_rr,cov_rb,cov_bb\n";
  for (int k = 0; k < poses; ++k) {
    if (k > 0) {
      const Eigen::Matrix3d R = random.root<3>(0.02);
      odometry += fmt::format("{},{},{},{}{}\n", k, T_step.x, T_step.y, T_step.theta + 0.01 * random.unit(),
                              random.triangle(Eigen::Matrix3d(R.transpose() * R), ','));
    }
    for (int landmark = 0; landmark < landmarks; ++landmark) {
      const Eigen::Matrix2d R = random.root<2>(0.05);
      const Eigen::Vector2d p = seen(k, landmark);
      observations += fmt::format("{},{},{},{}{}\n", k, landmark, p.norm(), std::atan2(p.y(), p.x()),
                                  random.triangle(Eigen::Matrix2d(R.transpose() * R), ','));
    }
  }
  return {{"log.yaml",
           "name: random\nassociation: known\nrange_sd_m: 0.1\nbearing_sd_rad: 0.1\nstart: {x_m: 0, y_m: 0, "
           "theta_rad: 0, cov_xx: 0.013, "
           "cov_xy: 0.0017, cov_xt: -0.0003, cov_yy: 0.011, cov_yt: 0.0007, cov_tt: 0.0019}\n"},
          {"odometry.csv", odometry},
          {"observations.csv", observations}};
}

struct Format {
  std::string name;
  Files files;
  std::string log;  // the file to open; empty: the folder
  std::vector<std::string> noise = {};
};

class RandomCovariances : public testing::TestWithParam<Format> {};

INSTANTIATE_TEST_SUITE_P(
    Formats, RandomCovariances,
    testing::Values(Format{"G2o", graph_log(false), "graph.txt"},
                    Format{"Isam", graph_log(true), "graph.txt"}, Format{"Own", own_log(), ""},
                    Format{
                        "Weighted",
                        own_log(),
                        "",
                        {"noise.range_sd_m=0.07", "noise.range_sd_per_m=0.013", "noise.bearing_sd_rad=0.02"}},
                    Format{"WeightedGraph",
                           graph_log(false),
                           "graph.txt",
                           {"noise.turn_sd_rad_per_sqrt_m=0.07", "noise.distance_sd_m_per_sqrt_m=0.03",
                            "noise.sideways_sd_m_per_sqrt_m=0.01"}}),
    [](const auto& format) { return format.param.name; });

RunResult replay(const LogChoice& log, const std::filesystem::path& to) {
  worlds::World world;
  world.estimators = {choice("ekf"), choice("seif"), choice("seif_exact")};
  PreparedRun run = prepare_replay(log, world, test_registry());
  std::filesystem::create_directories(to);
  run.plan.folder = to;
  run.plan.quiet = true;
  return execute(run);
}

TEST_P(RandomCovariances, AreReplayedToTheSameBits) {
  const TemporaryFolder folder;
  const Format& format = GetParam();
  write_files(folder / "log", format.files);
  const LogChoice log{.path = folder / "log" / format.log, .noise = {.overrides = format.noise}};
  const RunResult first = replay(log, folder / "first");
  const RunResult second = replay(LogChoice{.path = folder / "first"}, folder / "second");
  EXPECT_EQ(exit_code(first), 0) << first.error;
  EXPECT_EQ(first.summary.updates, poses);
  EXPECT_EQ(first.summary.trajectory_hash, second.summary.trajectory_hash);

  const std::vector<Event> given = read_all(*open_log(log));
  const std::vector<Event> recorded = read_all(*open_log({.path = folder / "first"}));
  ASSERT_EQ(given.size(), recorded.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    ASSERT_EQ(given[i].index(), recorded[i].index());
    if (std::holds_alternative<OdometryEvent>(given[i])) {
      EXPECT_EQ(odometry(given[i]).odometry.covariance, odometry(recorded[i]).odometry.covariance);
      continue;
    }
    for (std::size_t j = 0; j < landmarks; ++j) {
      EXPECT_EQ(scan(given[i]).scan.observations[j].covariance,
                scan(recorded[i]).scan.observations[j].covariance);
    }
  }
}

}  // namespace
}  // namespace harness
