// When a closure has bent the zone, so that messages have to be turned anew.
#include "seif/tree/zone_choice.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>

#include "seif/information_state.hpp"

namespace seif {
namespace {

using Eigen::Vector2d;

constexpr double view = 8.0;  // [m]

/// Two heaps of active landmarks, ten metres apart, as the latest plan had them.
struct TwoHeaps {
  TwoHeaps() {
    const int leaf = records.tree.new_leaf();
    while (static_cast<int>(records.nodes.size()) < records.tree.size()) records.nodes.push_back({});
    state.first_estimates().note_sighting_sd(0.02);
    for (std::size_t i = 0; i < places.size(); ++i) {
      state.activate(state.add_landmark(static_cast<LandmarkId>(i), places[i]));
      records.landmarks.push_back({.leaf = leaf, .home = places[i], .planned = places[i]});
    }
    choice.begin_scan(state, {}, view);
  }

  /// Moves the second heap against the first.
  bool is_bent_by(const Vector2d& step) {
    for (int slot = 3; slot < 6; ++slot) state.move_landmark(slot, step);
    return choice.is_bent(state);
  }

  std::array<Vector2d, 6> places{{{0, 0}, {1, 0}, {0, 1}, {10, 0}, {11, 0}, {10, 1}}};
  CondensationRecords records{CondensationOptions{}, Pose2{}};
  InformationState state{PoseEstimate{.mean = {}, .covariance = Eigen::Matrix3d::Identity()}};
  ZoneChoice choice{records};
};

TEST(ZoneChoice, AClosureThatMovesHeapsAgainstEachOtherBendsTheZone) {
  EXPECT_TRUE(TwoHeaps().is_bent_by({0, 4.0}));
  EXPECT_TRUE(TwoHeaps().is_bent_by({2.0, 0}));
}

TEST(ZoneChoice, MovingAndTurningTheWholeBendsNothing) {
  TwoHeaps heaps;
  const Pose2 motion{30.0, -20.0, 2.0};
  for (int slot = 0; slot < 6; ++slot)
    heaps.state.move_landmark(slot, motion * heaps.state.mean(slot) - heaps.state.mean(slot));
  EXPECT_FALSE(heaps.choice.is_bent(heaps.state));
}

TEST(ZoneChoice, LessThanATwentiethOfTheViewBendsNothing) {
  EXPECT_FALSE(TwoHeaps().is_bent_by({0.02 * view, 0}));
}

TEST(ZoneChoice, WhatTheNoiseOfASightingExplainsBendsNothing) {
  TwoHeaps heaps;
  heaps.state.first_estimates().note_sighting_sd(2.0);
  EXPECT_FALSE(heaps.is_bent_by({2.0, 0}));
}

}  // namespace
}  // namespace seif
