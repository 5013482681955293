// Screening before the estimators: which measurements are ignored, and which are not.
#include "harness/stream/screening.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace harness {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

LogDescription log_of_an_8_m_sensor() {
  LogDescription log;
  log.max_range = 8.0;
  return log;
}

seif::Observation seen(seif::LandmarkId landmark, double range, double bearing) {
  seif::Observation z{landmark, range, bearing, {}};
  z.covariance = Eigen::Vector2d(0.0025, 1e-4).asDiagonal();
  return z;
}

Event scan_of(const std::vector<seif::Observation>& observations) {
  ScanEvent event;
  event.scan = {3.0, observations};
  for (const seif::Observation& z : observations) event.true_ids.push_back(z.landmark);
  return event;
}

Event odometry(double x, double variance) {
  OdometryEvent event;
  event.odometry.t = 2.0;
  event.odometry.T_previous_current.x = x;
  event.odometry.covariance(0, 0) = variance;
  return event;
}

TEST(Screening, LeavesOutObservationsThatAreNoneWithTheirIds) {
  Screening screening(log_of_an_8_m_sensor());
  Event event = scan_of({seen(0, not_a_number, 0.0), seen(1, 2.0, 0.5), seen(2, 2.0, infinity),
                         seen(3, -1.0, 0.0), seen(4, 8.4, 0.0), seen(5, 8.6, 0.0), seen(6, 1e6, 0.0)});
  ASSERT_TRUE(screening.admit(event));
  const ScanEvent& scan = std::get<ScanEvent>(event);
  ASSERT_EQ(scan.scan.observations.size(), 2U);
  EXPECT_EQ(scan.scan.observations[0].landmark, 1);
  EXPECT_EQ(scan.scan.observations[1].landmark, 4);  // beyond 8 m by 8 of its standard deviations
  EXPECT_EQ(scan.true_ids, (std::vector<seif::LandmarkId>{1, 4}));
  EXPECT_EQ(screening.count(Rejection::observations_not_finite), 2);
  EXPECT_EQ(screening.count(Rejection::observations_out_of_range), 3);
  EXPECT_EQ(screening.first_t(), 3.0);
}

TEST(Screening, AScanOfWhichNothingIsLeftIsAnEmptyScan) {
  Screening screening(log_of_an_8_m_sensor());
  Event event = scan_of({seen(0, not_a_number, 0.0)});
  EXPECT_TRUE(screening.admit(event));
  EXPECT_TRUE(std::get<ScanEvent>(event).scan.observations.empty());
}

TEST(Screening, LeavesOutObservationsWithACovarianceThatIsNone) {
  Screening screening(log_of_an_8_m_sensor());
  for (const double variance : {0.0, -1.0, not_a_number, infinity, 1e-18, 1e300}) {
    seif::Observation z = seen(0, 1.0, 0.0);
    z.covariance(1, 1) = variance;
    Event event = scan_of({z});
    screening.admit(event);
    EXPECT_TRUE(std::get<ScanEvent>(event).scan.observations.empty()) << variance;
  }
  seif::Observation indefinite = seen(0, 1.0, 0.0);
  indefinite.covariance << 1.0, 2.0, 2.0, 1.0;
  Event event = scan_of({indefinite});
  screening.admit(event);
  EXPECT_TRUE(std::get<ScanEvent>(event).scan.observations.empty());
}

TEST(Screening, LeavesOutOdometryThatIsNone) {
  Screening screening(log_of_an_8_m_sensor());
  for (Event bad : {odometry(not_a_number, 0.1), odometry(infinity, 0.1), odometry(0.1, not_a_number)})
    EXPECT_FALSE(screening.admit(bad));
  EXPECT_EQ(screening.count(Rejection::odometry_not_finite), 3);
  for (Event bad : {odometry(2e4, 0.1), odometry(0.1, -0.1)}) EXPECT_FALSE(screening.admit(bad));
  EXPECT_EQ(screening.count(Rejection::odometry_out_of_range), 2);
  Event good = odometry(0.1, 0.0);  // known exactly
  EXPECT_TRUE(screening.admit(good));
}

TEST(Screening, NamesWhatItLeftOutAndNothingElse) {
  Screening screening(log_of_an_8_m_sensor());
  Event good = scan_of({seen(0, 1.0, 0.0)});
  screening.admit(good);
  EXPECT_TRUE(screening.named().empty());
  EXPECT_FALSE(screening.first_t());
  Event bad = odometry(not_a_number, 0.1);
  screening.admit(bad);
  ASSERT_EQ(screening.named().size(), 1U);
  EXPECT_EQ(screening.named().front().first, "odometry_not_finite");
}

}  // namespace
}  // namespace harness
