// The mean of the condensation tree, against sparse Cholesky of all of Omega, at every update.
#include "seif/tree/condensation_tree.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "seif/dense_oracle.hpp"
#include "seif/driven_state.hpp"
#include "seif/full_state.hpp"
#include "seif/linearisation.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/measurement_steps.hpp"
#include "seif/motion_update.hpp"
#include "seif/observation_factor.hpp"
#include "seif/path_drive.hpp"
#include "seif/ring_drive.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

using test::RingDrive;

/// All of Omega is one linear system then.
constexpr CondensationOptions linear{.turns = false};

/// The same filter twice: with the tree, and with all of Omega solved wherever the tree solves.
struct Twins {
  explicit Twins(const PoseEstimate& start, const CondensationOptions& options = linear, bool follows = false)
      : state(start), exact(start), tree(options, start.mean), exact_follows(follows) {
    state.keep_frozen_apart();
    state.first_estimates().settle_after(5);
    exact.first_estimates().settle_after(5);
    state.first_estimates().note_sighting_sd(0.04);  // [m] the noise of RingDrive and PathDrive
    exact.first_estimates().note_sighting_sd(0.04);
  }

  InformationState state;
  InformationState exact;
  CondensationTree tree;
  bool exact_follows;  // `exact` takes the means of the tree; its r is then their error

  void update(const Odometry& odometry, const Scan& scan, int theta_x = 6, int theta_max = 16) {
    motion_update(state, odometry);
    motion_update(exact, odometry);
    ASSERT_TRUE(activate_known(scan));
    take_in(scan, theta_x, theta_max);
  }

  void take_in(const Scan& scan, int theta_x = 6, int theta_max = 16) {
    add_known(state, scan);
    add_known(exact, scan);
    solve();
    add_new(scan);
    solve();
    update_first_estimates(state);
    update_first_estimates(exact);
    sparsify(theta_x, theta_max);
    solve();
    ASSERT_TRUE(tree.end_update(state));
  }

  bool activate_known(const Scan& scan) {
    std::vector<int> slots;
    double range = 0.0;
    for (const Observation& z : scan.observations) {
      range = std::max(range, z.range);
      if (const auto slot = state.find(z.landmark)) slots.push_back(*slot);
    }
    state.begin_scan();
    exact.begin_scan();
    if (!tree.activate(state, slots, range)) return false;
    if (exact_follows) follow();
    for (const int slot : slots) {  // the landmarks that need not wait
      if (exact.position(slot) < 0) exact.activate(slot);
      state.mark_seen(slot);
      exact.mark_seen(slot);
    }
    return true;
  }

  static void add_known(InformationState& to, const Scan& scan) {
    constexpr double closing_gate = 0.5;  // [-]
    std::vector<ObservationFactor> factors;
    linearise_known(to, scan, {}, closing_gate, factors);
    for (const ObservationFactor& factor : factors) add(to, factor);
  }

  void add_new(const Scan& scan) {
    for (const Observation& z : scan.observations) {
      if (state.find(z.landmark)) continue;
      for (InformationState* to : {&state, &exact}) {
        const int slot = to->add_landmark(z.landmark, invert_observation(to->pose(), {}, z).p_world_landmark);
        if (to == &state) tree.join(state, slot);
        to->mark_seen(slot);
        add(*to, linearise(*to, slot, z, {}));
      }
    }
  }

  void solve() {
    ASSERT_TRUE(tree.solve_window(state));
    if (exact_follows) {
      follow();
    } else {
      ASSERT_TRUE(solve_mean(exact));
    }
  }

  void follow() {
    Eigen::VectorXd d = -full_mu(exact);
    d.head<3>() += full_mu(state).head<3>();
    d(2) = wrap_angle(d(2));
    for (int slot = 0; slot < state.landmark_count(); ++slot) {
      d.segment<2>(3 + 2 * slot) += tree.mean(state, slot);
    }
    move_all(exact, d);
  }

  void sparsify(int theta_x, int theta_max) {
    std::vector<int> dropped;
    choose_surplus(state, {.theta_x = theta_x, .theta_max = theta_max}, dropped);
    if (dropped.empty()) return;
    ASSERT_TRUE(seif::sparsify(state, SparsificationRule::gauge_free, dropped));
    ASSERT_TRUE(seif::sparsify(exact, SparsificationRule::gauge_free, dropped));
    FrozenPiece piece;
    ASSERT_TRUE(freeze(state, dropped, piece));
    ASSERT_TRUE(tree.freeze(state, piece));
  }

  /// The largest distance of a landmark, or of the robot, from the exact solution. [m]
  double error() {
    double worst = std::hypot(state.pose().x - exact.pose().x, state.pose().y - exact.pose().y);
    for (int slot = 0; slot < state.landmark_count(); ++slot) {
      worst = std::max(worst, (tree.mean(state, slot) - exact.mean(slot)).norm());
    }
    return worst;
  }
};

constexpr double exact = 1e-8;  // [m]

/// Small leaves, which give deep trees in small worlds; all work of a new zone is done at once.
constexpr CondensationOptions deep{.most_in_leaf = 4, .most_hot = 10, .turns = false, .most_blocks = 0};

/// The same in slices: many observations arrive while a zone is being prepared.
CondensationOptions sliced(CondensationOptions options) {
  options.most_blocks = 300;
  return options;
}

/// Expects the exact mean in a drive. Adds to `waited` how many observations had to wait.
void expect_exact_mean(test::PathDrive drive, CondensationOptions options, std::int64_t* waited = nullptr) {
  options.most_unknowns = 100'000;  // no group is ever made
  Twins twins(drive.setup().start, options);
  for (int k = 0; !drive.at_end(); ++k) {
    drive.advance();
    twins.update(drive.odometry(), drive.scan());
    ASSERT_EQ(twins.tree.broken_invariant(twins.state), std::nullopt) << "update " << k;
    ASSERT_LT(twins.error(), exact) << "update " << k;
  }
  if (waited != nullptr) *waited += twins.tree.waited();
}

using test::Points;

/// `rounds` rounds along a polygon of sixteen corners.
Points circle(const Eigen::Vector2d& centre, double radius, double from, double rounds) {
  Points corners;
  for (int i = 0; i <= 16 * rounds; ++i) {
    const double angle = from + i * std::numbers::pi / 8;
    corners.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

Points joined(const std::vector<Points>& parts) {
  Points all;
  for (const Points& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

struct World {
  std::string name;
  Points (*path)();
};

const World worlds[] = {
    {"Chain",
     [] {
       return Points{{0, 0}, {45, 0}};
     }},
    {"Ring",
     [] {
       return circle({0, 0}, 9, 0, 2.3);
     }},
    {"Eight",
     [] {
       const Points left = circle({-6, 0}, 6, 0, 1);
       const Points right = circle({6, 0}, 6, std::numbers::pi, 1);
       return joined({left, right, left, right});
     }},
    {"BackAfterALongAbsence",
     [] {
       return Points{{0, 0}, {40, 0}, {40, 12}, {40, 0}, {0, 0}, {0, 5}};
     }},
    {"DitheringOnTheBorderOfLeaves",
     [] {
       Points corners{{0, 0}, {36, 0}};
       for (double x = 34; x > 2; x -= 4) {
         for (int k = 0; k < 3; ++k) corners.insert(corners.end(), {{x, 0}, {x + 2.5, 0}});
       }
       return corners;
     }},
    {"Serpentine",
     [] {
       return Points{{0, 0}, {16, 0}, {16, 4}, {0, 4}, {0, 8}, {16, 8}, {16, 12}, {0, 12}, {0, 0}, {8, 6}};
     }},
    {"Town",
     [] {
       return Points{{0, 0},  {14, 0},  {14, 14}, {0, 14}, {0, 0}, {14, 0},
                     {28, 0}, {28, 14}, {14, 14}, {14, 0}, {0, 14}};
     }},
};

class InWorld : public testing::TestWithParam<World> {};

INSTANTIATE_TEST_SUITE_P(All, InWorld, testing::ValuesIn(worlds),
                         [](const auto& world) { return world.param.name; });

constexpr unsigned seeds = test::under_sanitizer ? 1 : 20;

TEST_P(InWorld, TheMeanIsTheExactSolutionAfterEveryUpdate) {
  const Points path = GetParam().path();
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    expect_exact_mean({test::landmarks_along(path, seed), path, seed}, seed % 4 == 0 ? linear : deep);
  }
}

TEST_P(InWorld, TheMeanIsTheExactSolutionWhileTheZoneMovesInSlices) {
  const Points path = GetParam().path();
  std::int64_t waited = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    expect_exact_mean({test::landmarks_along(path, seed), path, seed}, sliced(deep), &waited);
  }
  if (test::under_sanitizer) return;                  // only one seed; maybe nothing had to wait in it
  EXPECT_EQ(waited > 0, GetParam().name != "Chain");  // the chain never comes back
}

/// Three clusters of landmarks with nothing in between.
TEST(CondensationTree, HeapsFarApartAreExact) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> spread(0.0, 2.0);
    Points landmarks;
    for (int i = 0; i < 60; ++i) landmarks.emplace_back(25.0 * (i % 3) + spread(random), spread(random));
    expect_exact_mean({landmarks, {{0, 0}, {50, 0}, {0, 0}, {25, 0}, {25, 2}}, seed}, deep);
  }
}

/// Random places, so that leaves become hot in any order.
TEST(CondensationTree, RandomEpisodesAreExact) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(100 + seed);
    std::uniform_real_distribution<double> anywhere(0.0, 18.0);
    Points landmarks;
    for (int i = 0; i < 70; ++i) landmarks.emplace_back(anywhere(random), anywhere(random));
    Points path;
    for (int i = 0; i < 8; ++i) path.emplace_back(anywhere(random), anywhere(random));
    std::uniform_int_distribution<int> size(2, 8);
    const int in_leaf = size(random);
    const CondensationOptions options{.most_in_leaf = in_leaf, .most_hot = 2 * size(random), .turns = false};
    expect_exact_mean({landmarks, path, seed}, seed % 2 == 0 ? options : sliced(options));
  }
}

/// Groups begin so early and are so coarse that even these small worlds are full of them.
constexpr CondensationOptions grouped{
    .most_in_leaf = 4, .most_hot = 10, .most_unknowns = 10, .grain = 0.5, .turns = false, .most_blocks = 0};
constexpr double residual_rounding = 1e-7;  // of r; one more observation changes r by about 1e3

/// The largest absolute value in r, over all rows or those of the window.
double largest(const Eigen::VectorXd& r) { return r.cwiseAbs().maxCoeff(); }

// While a group moves as one, the residual of its landmarks is not zero. It must still be known: it becomes
// zero once the landmarks move one by one.
TEST_P(InWorld, WhereGroupsMoveAsOneNothingOfTheResidualIsLost) {
  const Points path = GetParam().path();
  std::array<double, 2> most_left{};  // all work at once, and in slices
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    test::PathDrive drive(test::landmarks_along(path, seed), path, seed);
    Twins twins(drive.setup().start, seed % 2 == 0 ? grouped : sliced(grouped), true);
    for (int k = 0; !drive.at_end(); ++k) {
      drive.advance();
      twins.update(drive.odometry(), drive.scan());
      ASSERT_EQ(twins.tree.broken_invariant(twins.state), std::nullopt) << "update " << k;
      ASSERT_LT(largest(twins.exact.r()), residual_rounding) << "update " << k;
    }
    most_left[seed % 2] = std::max(most_left[seed % 2], largest(full_r(twins.exact)));
    ASSERT_TRUE(twins.tree.solve_all(twins.state));
    twins.follow();
    EXPECT_LT(largest(full_r(twins.exact)), residual_rounding);
  }
  EXPECT_GT(most_left[1], 1e4 * residual_rounding);  // otherwise there were no groups
  EXPECT_TRUE(seeds == 1 || most_left[0] > 1e4 * residual_rounding);
}

/// The same in random worlds, with leaves and slices of any size.
TEST(CondensationTree, OfRandomEpisodesNothingOfTheResidualIsLost) {
  const unsigned episodes = test::under_sanitizer ? 20 : 1'000;
  for (unsigned seed = 1; seed <= episodes; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> anywhere(0.0, 18.0);
    Points landmarks;
    for (int i = 0; i < 70; ++i) landmarks.emplace_back(anywhere(random), anywhere(random));
    Points path;
    for (int i = 0; i < 5; ++i) path.emplace_back(anywhere(random), anywhere(random));
    CondensationOptions options = grouped;
    options.most_in_leaf = std::uniform_int_distribution(2, 8)(random);
    options.most_hot = std::uniform_int_distribution(4, 16)(random);
    options.most_blocks = std::uniform_int_distribution(0, 3)(random) * 300;
    test::PathDrive drive(landmarks, path, seed);
    Twins twins(drive.setup().start, options, true);
    while (!drive.at_end()) {
      drive.advance();
      twins.update(drive.odometry(), drive.scan());
      ASSERT_LT(largest(twins.exact.r()), residual_rounding);
    }
    ASSERT_TRUE(twins.tree.solve_all(twins.state));
    twins.follow();
    ASSERT_LT(largest(full_r(twins.exact)), residual_rounding);
  }
}

TEST_P(InWorld, WhereGroupsMoveAsOneTheMeanIsNearlyExact) {
  const Points path = GetParam().path();
  const unsigned drives = std::max(seeds, 5U);  // a ratio of sums; one drive alone tells little
  double squared_error = 0.0;
  double squared_error_of_exact = 0.0;
  for (unsigned seed = 1; seed <= drives; ++seed) {
    const Points truth = test::landmarks_along(path, seed);
    test::PathDrive drive(truth, path, seed);
    Twins twins(drive.setup().start, {.most_unknowns = 10, .grain = 0.5, .turns = false}, true);
    while (!drive.at_end()) {
      drive.advance();
      twins.update(drive.odometry(), drive.scan());
    }
    ASSERT_TRUE(solve_mean(twins.exact));
    for (int slot = 0; slot < twins.state.landmark_count(); ++slot) {
      squared_error += (twins.tree.mean(twins.state, slot) - twins.exact.mean(slot)).squaredNorm();
      squared_error_of_exact +=
          (twins.exact.mean(slot) - truth[static_cast<std::size_t>(twins.exact.id(slot))]).squaredNorm();
    }
  }
  EXPECT_LT(std::sqrt(squared_error / squared_error_of_exact), 0.03);  // 0.023 in the town, less elsewhere
}

}  // namespace
}  // namespace seif
