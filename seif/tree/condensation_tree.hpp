// Recovers the mean. Information far from the robot is condensed along a tree, once; means there are computed when
// they are read. README.md here has the objects and the invariants, seif/README.md the reasons.
//
// Omega changes in the window alone, and the window is hot. So an update solves for robot and active landmarks
// with Omega + S, where S is the information of zone and messages: the exact mean of the whole Omega. The other
// landmarks follow by back-substitution. Where a front would grow too large, landmarks far from the robot are
// tied to groups that move as one body; their residuals are kept, and used when they are untied.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/tree/frozen_information.hpp"
#include "seif/tree/leaf_choice.hpp"
#include "seif/tree/leaf_elements.hpp"
#include "seif/tree/mean_reader.hpp"
#include "seif/tree/news_landmarks.hpp"
#include "seif/tree/plan_marking.hpp"
#include "seif/tree/plan_work.hpp"
#include "seif/tree/window_solution.hpp"
#include "seif/tree/zone_choice.hpp"
#include "seif/tree/zone_switch.hpp"
#include "seif/window_factor.hpp"

namespace seif {

/// The means of passive landmarks are those of mean(); the state holds old ones. At these means r is zero for all
/// passive landmarks that are not tied to groups.
class CondensationTree {
 public:
  CondensationTree(const CondensationOptions& options, const Pose2& start) : records_(options, start) {}
  CondensationTree(const CondensationTree&) = delete;  // its parts hold references to one another
  CondensationTree& operator=(const CondensationTree&) = delete;

  /// Before a scan is processed: moves the landmarks that it sees into the window, with their present means. Removes
  /// from `slots` those that must wait, because the zone is moving to them or away from them. `range`: of the
  /// farthest observation [m]. False if a matrix is not positive definite, as below.
  [[nodiscard]] bool activate(InformationState& state, std::vector<int>& slots, double range);

  void keep_fixed() { records_.options.turns = false; }  // from now on (CondensationOptions::turns)
  bool turns() const { return records_.options.turns; }

  /// Sends all messages anew, without any group: the exact solution, at the cost of a pass over the map.
  [[nodiscard]] bool solve_all(InformationState& state);

  /// Landmarks that have just joined the map and stay in the zone for ever, at known places: before all others.
  /// What is known of the places is added to the zone, where it does not turn.
  void hold(const InformationState& state, std::span<const int> slots, double sd);

  /// A landmark that has just joined the map, before it becomes active.
  void join(const InformationState& state, int slot);

  /// Moves the means of robot and active landmarks to the exact solution, and all others with them.
  [[nodiscard]] bool solve_window(InformationState& state);

  /// After a closure has moved the map: zone and window are linearised anew where their landmarks are now.
  [[nodiscard]] bool carry(InformationState& state);

  /// The factor of the last solve_window().
  const WindowFactor& window_factor() const { return window_.factor(); }

  /// After landmarks have left the window, with what was frozen with them.
  [[nodiscard]] bool freeze(const InformationState& state, const FrozenPiece& piece);

  /// After the last solve_window() of an update: works on the next zone; without it the zone never moves, unless
  /// most_blocks is 0. Until the next activate() no mean of a landmark may change, except by rounding.
  [[nodiscard]] bool end_update(InformationState& state);

  /// p_world_landmark, in O(log N). [m]
  Eigen::Vector2d mean(const InformationState& state, int slot) const;

  // For landmarks in the zone, directly after solve_window():
  bool is_in_zone(int slot) const { return records_.landmark(slot).zone_index != none; }
  template <class Visit>
  void for_each_in_zone(Visit&& visit) const {
    for (int h = 0; h < zone_.size(); ++h) visit(zone_.slot(h));
  }
  /// What is frozen, where its landmarks are now, without any group. Off the live path.
  FrozenInformation frozen_information(const InformationState& state) const;

  /// The covariance of [pose | landmarks], from (Omega + S)^-1 and from how inactive landmarks follow, to `out`
  /// (3+2m x 3+2m).
  void covariance(const InformationState& state, std::span<const int> slots,
                  Eigen::Ref<Eigen::MatrixXd> out) const {
    window_.covariance(state, slots, out);
  }

  /// Moves the zone at once so that it holds these landmarks, if it does not.
  [[nodiscard]] bool bring(InformationState& state, std::span<const int> slots);
  void want(int slot) { choice_.want(slot); }  // asks that the next zone hold this landmark

  std::int64_t blocks_touched() const;
  std::int64_t waited() const { return waited_; }  // [-] ignored observations of known landmarks, so far
  std::size_t memory_bytes() const;

  // What others know, while the tree is not busy: pieces of any landmarks. At last their plan begins.
  bool is_busy() const { return plan_.is_running || !news_.is_empty(); }
  Eigen::Vector2d home(int slot) const { return records_.landmark(slot).home; }
  void join_anywhere(const InformationState& state, int slot, const Eigen::Vector2d& home);
  void add_anywhere(const InformationState& state, const FrozenPiece& piece);
  void begin_news_plan(const InformationState& state);

  /// The first one, if any, at the cost of a pass over the map.
  std::optional<std::string> broken_invariant(const InformationState& state) const;

 private:
  static constexpr int none = -1;
  void enter(const InformationState& state, int slot, int leaf, const Eigen::Vector2d& home);
  bool is_ready(int slot) const;
  void add_to_elements(const FrozenPiece& piece);
  void begin_plan(const InformationState& state, bool of_all);
  [[nodiscard]] bool finish_plan(InformationState& state);
  [[nodiscard]] bool move_zone(InformationState& state);
  void repeat_news(const InformationState& state);
  std::int64_t blocks_left(const InformationState& state) const;
  void follow_in_zone(const InformationState& state);
  void read_zone(const InformationState& state) const;
  void read(const InformationState& state, int at) const;

  Front front_;  // before what holds its arrays
  CondensationRecords records_;
  HotZone zone_;
  CondensationPlan plan_;
  HeldLandmarks held_;
  MeanReader reader_{records_};               // for plans
  mutable MeanReader live_reader_{records_};  // for whoever looks: not counted
  Grouping grouping_{records_, plan_, front_};
  PlanMarking marking_{records_, plan_, grouping_};
  PlanWork work_{records_, plan_, front_, grouping_, reader_};
  ZoneChoice choice_{records_};
  LeafChoice leaves_{records_, plan_, marking_, zone_, choice_};
  ZoneSwitch switch_{records_, plan_, held_, zone_};
  LeafElements elements_{records_, front_.pool()};
  WindowSolution window_{records_, zone_};
  std::vector<int> zone_indices_;
  NewsLandmarks news_;
  std::int64_t epoch_ = 1;
  std::int64_t zone_followed_at_ = 0;  // epoch, as below
  mutable std::int64_t zone_read_at_ = 0;
  mutable Eigen::VectorXd zone_read_;  // with room to grow [m]
  bool switch_waits_ = false;          // a zone that is ready has waited for an update with room
  std::int64_t update_begun_at_ = 0, blocks_touched_ = 0, waited_ = 0;  // [-] the first two in blocks
};

}  // namespace seif
