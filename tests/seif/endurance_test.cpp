// Properties that must still hold after thousands of updates.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "dense_oracle.hpp"
#include "every_filter.hpp"
#include "ring_drive.hpp"
#include "seif/eseif.hpp"
#include "seif/full_state.hpp"
#include "seif/plain_seif.hpp"
#include "seif/seif.hpp"
#include "seif/start_points.hpp"

namespace seif {
namespace {

using test::RingDrive;
using test::under_sanitizer;

/// The belief of the filters that have one in sparse information form.
const InformationState& state_of(const Estimator& filter) {
  if (const auto* eseif = dynamic_cast<const Eseif*>(&filter)) return eseif->state();
  if (const auto* ours = dynamic_cast<const Seif*>(&filter)) return ours->state();
  return dynamic_cast<const PlainSeif&>(filter).state();
}

void expect_proper(const Estimator& filter, const InformationState& state) {
  const Eigen::MatrixXd Omega = filter.whole_belief_matrix();
  EXPECT_GT(Omega.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  Eigen::Index row = 3;
  for (const LandmarkEstimate& estimate : filter.map()) {
    const bool linked = !Omega.block<2, 3>(row, 0).isZero(0.0);
    EXPECT_EQ(linked, state.position(state.find(estimate.landmark).value()) >= 0) << estimate.landmark;
    row += 2;
  }
}

/// Products of three factors need not be symmetric to the last bit, but the asymmetry must not grow.
constexpr double last_bits = 4 * std::numeric_limits<double>::epsilon();

/// The largest difference between the two triangles of the window, relative to its largest element.
double asymmetry(const InformationState& state) {
  const Eigen::MatrixXd Omega = state.Omega();
  return (Omega - Omega.transpose()).cwiseAbs().maxCoeff() / Omega.cwiseAbs().maxCoeff();
}

struct Endurance {
  const char* filter;
  int updates;
  int under_sanitizer;  // updates
  /// The most landmarks that may be active after a scan of `in_view` landmarks.
  std::function<int(int in_view)> bound;

  /// The name in the message of a failure.
  friend void PrintTo(const Endurance& endurance, std::ostream* os) { *os << endurance.filter; }
};

const Endurance filters[] = {
    {"seif_report", 10'000, 1'000, [](int) { return 6; }},
    {"seif_gauge_free", 10'000, 200, [](int in_view) { return std::max(16, 6 + in_view); }},
    {"eseif", 10'000, 200, [](int) { return 10; }},
    {"seif", 10'000, 1'000, [](int in_view) { return std::max(16, in_view); }}};

class EnduringFilter : public testing::TestWithParam<Endurance> {};

INSTANTIATE_TEST_SUITE_P(All, EnduringFilter, testing::ValuesIn(filters),
                         [](const auto& filter) { return std::string(filter.param.filter); });

TEST_P(EnduringFilter, StaysProperSymmetricAndWithinItsBounds) {
  RingDrive drive(60, 21);
  const auto filter = test::make(GetParam().filter, drive.setup());
  const InformationState& state = state_of(*filter);
  drive.step(*filter);  // every landmark is new, and none can be dropped yet
  const int updates = under_sanitizer ? GetParam().under_sanitizer : GetParam().updates;
  for (int k = 1; k <= updates; ++k) {
    drive.step(*filter);
    const int in_view = static_cast<int>(drive.scan().observations.size());
    ASSERT_LE(state.active_count() - active_start_points(state), GetParam().bound(in_view)) << "update " << k;
    ASSERT_LT(asymmetry(state), last_bits) << "update " << k;
    if (k % (updates / 10) == 0) expect_proper(*filter, state);
  }
  EXPECT_EQ(filter->map().size(), 60u);
}

}  // namespace
}  // namespace seif
