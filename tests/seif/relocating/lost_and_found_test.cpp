// Robots that are carried off, and slip, among landmarks with and without names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "seif/path_drive.hpp"
#include "seif/registry.hpp"
#include "seif/ring_drive.hpp"

namespace seif {
namespace {

using test::ignore;
using test::PathDrive;
using test::Points;

std::unique_ptr<Estimator> make(const std::string& type, bool has_names, const EstimatorSetup& setup,
                                Options more = {}) {
  const Registry registry = standard_estimators();
  const EstimatorType* found = registry.find(type);
  Options options;
  for (const OptionSpec& spec : found->options) options[spec.key] = spec.fallback;
  if (!has_names) options["association"] = std::string("joint");
  for (const auto& [key, value] : more) options[key] = value;
  return found->make(setup, options);
}

/// Landmarks in a square around a point, none nearer than 0.8 m to another.
void scatter(Points& landmarks, int count, const Eigen::Vector2d& centre, double half, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-half, half);
  for (int tries = 0; count > 0 && tries < 100'000; ++tries) {
    const Eigen::Vector2d p = centre + Eigen::Vector2d(place(random), place(random));
    if (std::ranges::any_of(landmarks, [&](const auto& other) { return (other - p).norm() < 0.8; })) continue;
    landmarks.push_back(p);
    --count;
  }
}

Points square(const Eigen::Vector2d& centre, double half, int rounds) {
  Points corners{centre + Eigen::Vector2d(-half, -half)};
  for (int i = 0; i < rounds; ++i) {
    for (const auto& [x, y] :
         {std::pair(half, -half), std::pair(half, half), std::pair(-half, half), std::pair(-half, -half)})
      corners.emplace_back(centre.x() + x, centre.y() + y);
  }
  return corners;
}

class Lost : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  std::string type() const { return std::get<0>(GetParam()); }
  bool has_names() const { return std::get<1>(GetParam()); }

  void take(Estimator& filter, const Odometry& odometry, Scan scan) const {
    if (!has_names()) {
      for (Observation& z : scan.observations) z.landmark = no_landmark;
    }
    filter.motion_update(odometry);
    filter.measurement_update(scan, ignore);
  }
  /// Drives to the end. A drive that begins elsewhere has carried the robot there.
  void follow(Estimator& filter, PathDrive& drive) const {
    while (!drive.at_end()) {
      drive.advance();
      take(filter, drive.odometry(), drive.scan());
    }
  }
  static double error(const Estimator& filter, const PathDrive& drive) {
    return std::hypot(filter.pose().x - drive.truth().x, filter.pose().y - drive.truth().y);
  }
};

INSTANTIATE_TEST_SUITE_P(Filters, Lost, testing::Combine(testing::Values("ekf", "seif"), testing::Bool()),
                         [](const auto& test) {
                           return std::get<0>(test.param) +
                                  (std::get<1>(test.param) ? "WithNames" : "WithoutNames");
                         });

TEST_P(Lost, ARobotThatIsCarriedOffTwiceIsFoundTwice) {
  Points landmarks;
  scatter(landmarks, 60, {0.0, 0.0}, 9.0, 1);
  PathDrive home(landmarks, square({0.0, 0.0}, 5.0, 2), 1);
  const auto filter = make(type(), has_names(), home.setup());
  follow(*filter, home);
  EXPECT_EQ(filter->counts().relocations, 0);
  const std::size_t mapped = filter->map().size();
  PathDrive first(landmarks, {{2.0, 4.0}, {2.0, -4.0}}, 2);
  follow(*filter, first);
  EXPECT_EQ(filter->counts().relocations, 1);
  EXPECT_LT(error(*filter, first), 0.3);
  PathDrive second(landmarks, {{-5.0, 5.0}, {3.0, 5.0}}, 3);
  follow(*filter, second);
  EXPECT_EQ(filter->counts().relocations, 2);
  EXPECT_LT(error(*filter, second), 0.3);
  EXPECT_LE(filter->map().size(), mapped + 3) << "nothing twice";
}

// 30 m from all that it knows, it waits, and maps what it sees apart from the map. When it comes home, both are joined.
TEST_P(Lost, AmongLandmarksThatItHasNeverSeenItWaitsAndHarmsNothing) {
  Points landmarks;
  scatter(landmarks, 40, {0.0, 0.0}, 7.0, 2);
  scatter(landmarks, 30, {30.0, 0.0}, 6.0, 3);
  PathDrive home(landmarks, square({0.0, 0.0}, 4.0, 2), 1);
  const auto filter = make(type(), has_names(), home.setup());
  follow(*filter, home);
  const std::vector<LandmarkEstimate> before = filter->map();
  PathDrive away(landmarks, square({30.0, 0.0}, 3.0, 2), 2);
  follow(*filter, away);
  EXPECT_EQ(filter->counts().relocations, 0);
  const std::vector<LandmarkEstimate> meanwhile = filter->map();
  ASSERT_EQ(meanwhile.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT((meanwhile[i].mean - before[i].mean).norm(), 1e-4) << "landmark " << before[i].landmark;
  PathDrive back(landmarks, {{27.0, -3.0}, {6.0, 0.0}, {-4.0, 0.0}, {4.0, 0.0}}, 3);
  follow(*filter, back);
  EXPECT_EQ(filter->counts().relocations, 1);
  EXPECT_LT(error(*filter, back), 0.3);
  EXPECT_GT(filter->map().size(), before.size() + 5) << "what it has mapped meanwhile joins";
}

// A fifth of the landmarks has been moved while the robot was carried.
TEST_P(Lost, IsFoundAmongLandmarksOfWhichSomeHaveBeenMoved) {
  Points landmarks;
  scatter(landmarks, 60, {0.0, 0.0}, 9.0, 4);
  PathDrive home(landmarks, square({0.0, 0.0}, 5.0, 2), 1);
  const auto filter = make(type(), has_names(), home.setup(), {{"gate", 25.0}});
  follow(*filter, home);
  Points moved = landmarks;
  for (std::size_t i = 0; i < moved.size(); i += 5) moved[i] += Eigen::Vector2d(1.5, -1.0);
  PathDrive away(moved, {{3.0, 4.0}, {3.0, -4.0}, {-4.0, -4.0}}, 2);
  follow(*filter, away);
  EXPECT_GE(filter->counts().relocations, 1);
  EXPECT_LT(error(*filter, away), 0.3);
}

// Names alone can be misread.
TEST(LostByName, IsFoundWhereOneNameInTwentyIsWrong) {
  for (const std::string type : {"ekf", "seif"}) {
    Points landmarks;
    scatter(landmarks, 60, {0.0, 0.0}, 9.0, 5);
    PathDrive home(landmarks, square({0.0, 0.0}, 5.0, 2), 1);
    const auto filter = make(type, true, home.setup(), {{"gate", 25.0}});
    while (!home.at_end()) {
      home.advance();
      filter->motion_update(home.odometry());
      filter->measurement_update(home.scan(), ignore);
    }
    PathDrive away(landmarks, {{3.0, 4.0}, {3.0, -4.0}, {-4.0, -4.0}}, 2);
    std::mt19937_64 random(6);
    std::bernoulli_distribution is_misread(0.05);
    std::uniform_int_distribution<LandmarkId> any(0, 59);
    while (!away.at_end()) {
      away.advance();
      Scan scan = away.scan();
      for (Observation& z : scan.observations) {
        if (is_misread(random)) z.landmark = any(random);
      }
      filter->motion_update(away.odometry());
      filter->measurement_update(scan, ignore);
    }
    EXPECT_EQ(filter->counts().relocations, 1) << type;
    EXPECT_LT(std::hypot(filter->pose().x - away.truth().x, filter->pose().y - away.truth().y), 0.3) << type;
  }
}

/// A ring with a gap in which the robot sees nothing.
Points ring_with_gap(const Points& corners) {
  Points landmarks = test::landmarks_along(corners, 7);
  std::erase_if(landmarks,
                [](const Eigen::Vector2d& p) { return p.x() > 26.0 && p.y() > 6.0 && p.y() < 20.0; });
  return landmarks;
}

/// Landmarks of the map that stand where another one stands, within half a metre.
int duplicates(const Estimator& filter) {
  const std::vector<LandmarkEstimate> map = filter.map();
  int count = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((map[i].mean - map[j].mean).norm() < 0.5) ++count;
    }
  }
  return count;
}

// The wheels slip by 20 degrees where nothing is in view, in the first round. So the map is bent there, and when the robot
// comes back to where it began, nothing is where it believes it.
TEST(ClosingWithoutNames, IsFoundBeyondAllGates) {
  const Points corners{{0.0, 0.0}, {30.0, 0.0}, {30.0, 26.0}, {0.0, 26.0}, {0.0, 0.0}, {30.0, 0.0}};
  const Points landmarks = ring_with_gap(corners);
  for (const std::string type : {"ekf", "seif"}) {
    for (const std::string relocate : {"when_lost", "never"}) {
      PathDrive drive(landmarks, corners, 3);
      const auto filter = make(type, false, drive.setup(), {{"relocate", relocate}});
      for (int step = 0; !drive.at_end(); ++step) {
        drive.advance();
        Odometry odometry = drive.odometry();
        const bool slips = step > 60 && drive.scan().observations.empty() && drive.truth().y > 12.0 &&
                           drive.truth().y <= 12.5;
        if (slips) odometry.T_previous_current.theta += 0.35;
        Scan scan = drive.scan();
        for (Observation& z : scan.observations) z.landmark = no_landmark;
        filter->motion_update(odometry);
        filter->measurement_update(scan, ignore);
      }
      if (relocate == "never") {
        EXPECT_GT(filter->map().size(), landmarks.size() + 10) << type << ": a second map begins";
      } else {
        EXPECT_LE(filter->map().size(), landmarks.size() + 10) << type;
        EXPECT_LE(duplicates(*filter), 2) << type;
      }
    }
  }
}

}  // namespace
}  // namespace seif
