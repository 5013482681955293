// Public data sets, if SEIFBED_DATASETS names a folder that holds them: docs/datasets.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "harness/estimators/registry.hpp"
#include "harness/fixtures.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/reference.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/statistics/alignment.hpp"

namespace harness {
namespace {

/// The folder of the data sets; skips the test if the variable is not set.
class Datasets : public testing::Test {
 protected:
  void SetUp() override {
    const char* named = std::getenv("SEIFBED_DATASETS");
    if (named == nullptr) GTEST_SKIP() << "SEIFBED_DATASETS is not set";
    folder_ = named;
  }

  std::filesystem::path folder_;
};

struct Replayed {
  Summary summary;
  EstimatorScore ekf;
  EstimatorScore seif;
  ReferenceScore batch;
  DistanceFromReference ekf_from_batch;
  DistanceFromReference seif_from_batch;
};

/// The settings of `seifbed replay LOG`. Scores that take time are computed only at the end.
worlds::LoadResult settings_of(const LogChoice& log, const seif::Registry& registry) {
  ReplayChoices choices;
  choices.overrides = {"scoring.interval_s=1e6"};
  choices.defaults = default_settings(format_of(log));
  return load_replay_settings(log.path, choices, registry);
}

/// Like `seifbed replay LOG` and `seifbed score` with the reference.
Replayed replay_with(const LogChoice& log, const std::string& reference) {
  const seif::Registry registry = known_estimators();
  const TemporaryFolder folder;
  const worlds::LoadResult settings = settings_of(log, registry);
  PreparedRun run = prepare_replay(log, settings.world.value(), registry);
  run.plan.folder = folder.path();
  run.plan.quiet = true;
  write_replayed_world(folder.path(), log.path, settings.resolved);
  Replayed result;
  result.summary = execute(run).summary;
  for (const std::string& failure : result.summary.failures) EXPECT_EQ(failure, "");
  result.ekf = result.summary.score.estimators.at(0);
  result.seif = result.summary.score.estimators.at(1);
  result.batch = score_reference(reference, folder.path(), result.summary, {}, registry);
  result.ekf_from_batch = distance_from_reference(folder.path(), "ekf", result.batch.estimate);
  result.seif_from_batch = distance_from_reference(folder.path(), "seif", result.batch.estimate);
  return result;
}

struct MrclamRun {
  std::string folder;
  int robot;
  // The largest error of the map over that of
  double of_the_optimum = 1.10;
  double of_the_ekf = 1.05;
};

class VictoriaParkGraph : public Datasets {};
class VictoriaParkTrees : public Datasets {};
class CityTrees : public Datasets {};
class FreiburgCourse : public Datasets {};
class FreiburgGraph : public Datasets {};
class Mrclam : public Datasets, public testing::WithParamInterface<MrclamRun> {};
INSTANTIATE_TEST_SUITE_P(Robots, Mrclam,
                         testing::Values(MrclamRun{"MRCLAM_Dataset6", 1, 1.20, 1.12},
                                         MrclamRun{"MRCLAM_Dataset6", 2}, MrclamRun{"MRCLAM_Dataset6", 3},
                                         MrclamRun{"MRCLAM_Dataset6", 4}, MrclamRun{"MRCLAM_Dataset6", 5},
                                         MrclamRun{"MRCLAM_Dataset4", 3}),
                         [](const auto& run) {
                           return run.param.folder + "Robot" + std::to_string(run.param.robot);
                         });

// Robot 1 exceeds what the others keep: 1.18 times the optimum, 1.10 times the EKF. Its trajectory is at the optimum.
TEST_P(Mrclam, SeifIsAsGoodAsTheEkfAndNearTheOptimum) {
  const std::filesystem::path folder = folder_ / "mrclam";
  const Replayed run =
      replay_with({.path = folder / GetParam().folder, .robot = GetParam().robot}, "robust_batch");
  EXPECT_EQ(run.seif.landmarks_mapped, 15);
  EXPECT_LE(*run.seif.landmarks.rmse_aligned, GetParam().of_the_ekf * *run.ekf.landmarks.rmse_aligned);
  EXPECT_LE(*run.seif.landmarks.rmse_aligned,
            GetParam().of_the_optimum * *run.batch.score.landmarks.rmse_aligned);
  EXPECT_LT(*run.seif.trajectory.rmse_aligned, 0.4);  // [m] in a hall of 15 m
  EXPECT_LT(*run.seif.nees_pose, 6.0);                // at the end; the EKF has 22 for robot 5
  EXPECT_LT(*run.seif.gated, run.summary.updates / 100);
}

TEST_F(VictoriaParkGraph, SeifIsNoFartherFromTheOptimumThanTheEkf) {
  const std::filesystem::path folder = folder_ / "victoria_park";
  const Replayed run = replay_with({.path = folder / "isam_victoriaPark.txt"}, "batch");
  EXPECT_EQ(run.seif.landmarks_mapped, 151);
  EXPECT_FALSE(run.seif.landmarks.rmse);  // there is no ground truth
  EXPECT_LE(*run.seif_from_batch.landmarks.rmse_aligned, *run.ekf_from_batch.landmarks.rmse_aligned);
}

/// The positions of the GPS receiver, one per second; it was mounted next to the laser. Times count from the
/// first row of the odometry, as in the run.
std::vector<TimedPose> read_gps(const std::filesystem::path& folder) {
  constexpr double first_odometry = 21.940;  // [s]
  std::istringstream text(test::read_file(folder / "derived_gps.txt"));
  std::vector<TimedPose> fixes;
  for (std::string line; std::getline(text, line);) {
    TimedPose fix;
    std::istringstream row(line);
    if (!(row >> fix.t >> fix.T_world_robot.x >> fix.T_world_robot.y)) continue;
    fix.t -= first_odometry;
    fixes.push_back(fix);
  }
  return fixes;
}

struct FromGps {
  std::vector<Eigen::Vector2d> gps, est;  // [m] at the times of the fixes, each in its own frame
};

/// For each fix: the position of the laser by the estimate nearest in time, if there is one within a tenth of a
/// second.
FromGps pair_with_gps(const std::vector<TimedPose>& fixes, const std::vector<TimedPose>& poses,
                      const Eigen::Vector2d& p_robot_laser) {
  FromGps pairs;
  for (const TimedPose& fix : fixes) {
    auto after = std::ranges::lower_bound(poses, fix.t, {}, &TimedPose::t);
    if (after != poses.begin() && (after == poses.end() || fix.t - (after - 1)->t < after->t - fix.t))
      --after;
    if (after == poses.end() || std::abs(after->t - fix.t) > 0.1) continue;
    pairs.gps.emplace_back(fix.T_world_robot.x, fix.T_world_robot.y);
    pairs.est.push_back(after->T_world_robot * p_robot_laser);
  }
  return pairs;
}

/// The median distance after an alignment that ignores fixes that jump: it uses the nearer half of the fixes,
/// several times.
double median_distance(const FromGps& pairs) {
  std::vector<Eigen::Vector2d> from = pairs.est;
  std::vector<Eigen::Vector2d> to = pairs.gps;
  std::vector<double> distances;
  for (int round = 0; round < 20; ++round) {
    const seif::Pose2 T_gps_est = align(from, to).value();
    distances.clear();
    for (std::size_t i = 0; i < pairs.gps.size(); ++i)
      distances.push_back((T_gps_est * pairs.est[i] - pairs.gps[i]).norm());
    std::vector<double> sorted = distances;
    std::ranges::sort(sorted);
    const double median = sorted[sorted.size() / 2];
    from.clear();
    to.clear();
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (distances[i] > median) continue;
      from.push_back(pairs.est[i]);
      to.push_back(pairs.gps[i]);
    }
    if (round == 19) return median;
  }
  return 0.0;
}

TEST_F(VictoriaParkTrees, TreesWithoutNamesMakeAMapThatFitsToGps) {
  const std::filesystem::path folder = folder_ / "victoria_park";
  const LogChoice log{.path = folder};
  const seif::Registry registry = known_estimators();
  const TemporaryFolder to;
  const worlds::LoadResult settings = settings_of(log, registry);
  PreparedRun run = prepare_replay(log, settings.world.value(), registry);
  run.plan.folder = to.path();
  run.plan.quiet = true;
  const Summary summary = execute(run).summary;
  const std::vector<TimedPose> fixes = read_gps(folder);
  ASSERT_EQ(fixes.size(), 4466U);
  const seif::Pose2& T_robot_laser = run.log->T_robot_sensor;
  const Eigen::Vector2d p_robot_laser(T_robot_laser.x, T_robot_laser.y);
  for (std::size_t i = 0; i < summary.score.estimators.size(); ++i) {
    const EstimatorScore& score = summary.score.estimators[i];
    EXPECT_EQ(summary.failures.at(i), "");
    const double median =
        median_distance(pair_with_gps(fixes, read_trajectory(to.path(), score.name), p_robot_laser));
    std::cout << score.name << ": " << *score.landmarks_mapped << " landmarks, " << median << " m from GPS, "
              << *score.associations_left_out << " of the observations left out\n";
    EXPECT_LT(median, 1.5) << score.name << "; dead reckoning is at 69 m";
    EXPECT_GT(*score.landmarks_mapped, 150) << score.name;
    EXPECT_LT(*score.landmarks_mapped, 300) << score.name;
  }
}

TEST_F(CityTrees, MapsAreThoseOfTheTruth) {
  const std::filesystem::path folder = folder_ / "city_trees";
  const Replayed run = replay_with(
      {.path = folder / "cityTrees10000.txt", .truth = folder / "cityTrees10000_groundtruth.txt"}, "batch");
  EXPECT_EQ(run.seif.landmarks_mapped, 100);
  EXPECT_EQ(run.seif.landmarks_spurious, 0);
  EXPECT_LE(*run.seif.landmarks.rmse_aligned, 1.05 * *run.ekf.landmarks.rmse_aligned);
  EXPECT_LT(*run.seif.landmarks.rmse_aligned, 1.5 * *run.batch.score.landmarks.rmse_aligned);
}

TEST_F(FreiburgCourse, MapsAreThoseOfTheTruth) {
  const std::filesystem::path folder = folder_ / "freiburg_course";
  const Replayed run = replay_with({.path = folder}, "batch");
  EXPECT_EQ(run.seif.landmarks_mapped, 9);
  EXPECT_LE(*run.seif.landmarks.rmse_aligned, 1.05 * *run.ekf.landmarks.rmse_aligned);
  EXPECT_LE(*run.seif.landmarks.rmse_aligned, 1.10 * *run.batch.score.landmarks.rmse_aligned);
  EXPECT_EQ(run.summary.log_counts,
            (std::vector<std::pair<std::string, std::int64_t>>{{"negative_ranges", 1}}));
}

TEST_F(FreiburgGraph, IsReadWhole) {
  const std::filesystem::path folder = folder_ / "freiburg_course";
  const Replayed run = replay_with({.path = folder / "simulation-pose-landmark.g2o"}, "batch");
  EXPECT_EQ(run.seif.landmarks_mapped, 36);
  EXPECT_LE(*run.seif_from_batch.landmarks.rmse_aligned, 1.05 * *run.ekf_from_batch.landmarks.rmse_aligned);
}

}  // namespace
}  // namespace harness
