// Each step of the constant-time filter alone: the same local situation touches as many blocks in a map of
// 20,000 landmarks as in one of 1,000, and allocates nothing. Mean recovery beyond the window is tested
// separately.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "allocation_counter.hpp"
#include "ring_drive.hpp"
#include "seif/couplings.hpp"
#include "seif/information_state.hpp"
#include "seif/measurement_update.hpp"
#include "seif/motion_update.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

constexpr int small_map = 1'000;
constexpr int large_map = test::under_sanitizer ? 2'000 : 20'000;

/// A robot at the end of a straight corridor with one landmark on each side of every metre. It has seen all of
/// them, the landmarks of the last three metres in each scan. There are no errors, so the mean needs no
/// recovery.
class Corridor {
 public:
  explicit Corridor(int landmarks) : state_({.mean = {}, .covariance = 1e-4 * Eigen::Matrix3d::Identity()}) {
    scan_.reserve(16);
    surplus_.reserve(16);
    for (int metre = 1; metre <= landmarks / 2; ++metre) {
      motion_update(state_, ahead());
      look(metre - 2, metre);
      drop_all_but_six();
    }
  }

  InformationState& state() { return state_; }

  static Odometry ahead() {
    Odometry u{.t = 0.0, .T_previous_current = {1.0, 0.0, 0.0}};
    u.covariance.diagonal() << 1e-4, 0.0, 1e-5;
    return u;
  }

  void look(int first_metre, int last_metre) {
    scan_.clear();
    for (int metre = std::max(1, first_metre); metre <= last_metre; ++metre) {
      for (const int side : {0, 1}) {
        const Eigen::Vector2d p = inverse(state_.pose()) * Eigen::Vector2d(metre, side == 0 ? 1.5 : -1.5);
        Observation z{
            .landmark = 2 * (metre - 1) + side, .range = p.norm(), .bearing = std::atan2(p.y(), p.x())};
        z.covariance.diagonal() << 4e-4, 1e-4;
        scan_.push_back(z);
      }
    }
    measurement_update(state_, scan_, {});
  }

  void choose_surplus() {
    choose_to_drop(state_, DropOrder::least_recently_seen, std::max(0, state_.active_count() - 6), surplus_);
  }

  void drop_all_but_six() {
    choose_surplus();
    if (surplus_.empty()) return;
    ASSERT_TRUE(sparsify(state_, SparsificationRule::gauge_free, surplus_));
  }

 private:
  InformationState state_;
  std::vector<Observation> scan_;
  std::vector<int> surplus_;
};

struct Work {
  std::int64_t blocks = 0;
  long allocations = 0;
};

Work work_of(int landmarks, const std::function<void(Corridor&)>& prepare,
             const std::function<void(Corridor&)>& step) {
  Corridor corridor(landmarks);
  prepare(corridor);
  const Work before{corridor.state().blocks_touched(), allocations()};
  step(corridor);
  return {corridor.state().blocks_touched() - before.blocks, allocations() - before.allocations};
}

void expect_the_same_work(const std::function<void(Corridor&)>& prepare,
                          const std::function<void(Corridor&)>& step) {
  const Work in_small = work_of(small_map, prepare, step);
  const Work in_large = work_of(large_map, prepare, step);
  EXPECT_GT(in_small.blocks, 0);
  EXPECT_EQ(in_large.blocks, in_small.blocks);
  EXPECT_EQ(in_small.allocations, 0);
  EXPECT_EQ(in_large.allocations, 0);
}

const auto nothing = [](Corridor&) {};

/// Turns back to the landmarks that were dropped last.
void look_back(Corridor& corridor) {
  const int end = corridor.state().landmark_count() / 2;
  corridor.look(end - 5, end);
}

TEST(CountedWork, MotionUpdate) {
  expect_the_same_work(nothing,
                       [](Corridor& corridor) { motion_update(corridor.state(), Corridor::ahead()); });
}

TEST(CountedWork, MeasurementUpdateOfActivePassiveAndNewLandmarks) {
  expect_the_same_work(nothing, [](Corridor& corridor) {
    const int end = corridor.state().landmark_count() / 2;
    corridor.look(end - 2, end + 1);
    EXPECT_EQ(corridor.state().active_count(), 8);
  });
}

TEST(CountedWork, Sparsify) {
  expect_the_same_work(look_back, [](Corridor& corridor) {
    EXPECT_EQ(corridor.state().active_count(), 12);
    corridor.drop_all_but_six();
    EXPECT_EQ(corridor.state().active_count(), 6);
  });
}

TEST(CountedWork, ActivateAndDeactivate) {
  expect_the_same_work(nothing, [](Corridor& corridor) {
    InformationState& state = corridor.state();
    const int slot = state.landmark_count() - 8;  // has links to those that are active
    ASSERT_LT(state.position(slot), 0);
    const int position = state.activate(slot);
    state.deactivate(position);
  });
}

TEST(CountedWork, ChooseToDropAllocatesNothing) {
  for (const int landmarks : {small_map, large_map}) {
    Corridor corridor(landmarks);
    look_back(corridor);
    corridor.choose_surplus();
    const long before = allocations();
    corridor.choose_surplus();
    EXPECT_EQ(allocations(), before);
  }
}

/// The number of couplings of the robot and of some landmarks: active ones, passive ones with links to them,
/// and one in the middle of the map. Reads them twice; the second time, nothing may be allocated or counted.
std::vector<std::size_t> read_couplings(const InformationState& state) {
  const int end = state.landmark_count();
  std::vector<Coupling> couplings;
  std::vector<std::size_t> sizes;
  for (const LandmarkId of : {no_landmark, end - 1, end - 6, end - 7, end - 8, end / 2}) {
    couplings_of(state, of, couplings);
    sizes.push_back(couplings.size());
    EXPECT_GT(couplings.size(), 0U);
    const Work before{state.blocks_touched(), allocations()};
    couplings_of(state, of, couplings);
    EXPECT_EQ(state.blocks_touched(), before.blocks);
    EXPECT_EQ(allocations(), before.allocations);
  }
  return sizes;
}

TEST(CountedWork, CouplingsAreAsManyInALargeMapAndReadingThemAllocatesNothing) {
  Corridor in_small(small_map);
  Corridor in_large(large_map);
  EXPECT_EQ(read_couplings(in_large.state()), read_couplings(in_small.state()));
}

}  // namespace
}  // namespace seif
