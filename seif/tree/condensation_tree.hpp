// Recovers the mean. Information far from the robot is condensed along a tree, once; means there are computed when
// they are read.
//
//           o            A leaf holds about eight landmarks. The leaves around the robot are hot (*): the hub
//        /     \         (HotZone) holds their landmarks. Every other node sends one message towards the hub:
//      hub      o        the information behind the node, after elimination of the landmarks that have no
//     /   \    / \       block with anything before it (Front). So a message changes only if a leaf behind
//    0*   1*  2   3      it becomes hot or cold, or if the hub moves past it.
//
// Omega changes in the window alone, and the window is hot. So an update solves for robot and active landmarks
// with Omega + S, where S is the information of hub and messages: the exact mean of the whole Omega. The other
// landmarks follow by back-substitution. Where a front would grow too large, landmarks far from the robot are
// tied to groups that move as one body; their residuals are kept, and used when they are untied. seif/README.md
// explains more.
//
// Glossary: a leaf owns a block Omega_ij if it is the older of the leaves of i and j; it mentions the
//           landmarks of its blocks. A landmark is complete where all leaves that mention it have met.
//           It is settled where it is eliminated or tied. Stale: a message to be sent anew.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/tree/condensation_nodes.hpp"
#include "seif/tree/homes.hpp"
#include "seif/tree/hot_zone.hpp"
#include "seif/tree/leaf_element.hpp"
#include "seif/tree/leaf_tree.hpp"
#include "seif/tree/moved_boundary.hpp"
#include "seif/window_factor.hpp"

namespace seif {

struct CondensationOptions {
  int most_in_leaf = 8;  // [-] landmarks of a leaf as it grows
  int most_hot = 24;     // [-] landmarks beyond which leaves without an active one do not stay hot
  /// [-] Unknowns of a front above which landmarks far from the robot are tied to rigid groups.
  int most_unknowns = 200;
  double grain = 0.25;  // [-] distance over size of the coarsest groups
  /// What was frozen turns with the part of the map that it is in; otherwise it stays as it was turned then.
  bool turns = true;
  /// [-] Blocks of messages that one update prepares for the next zone; more if the robot would arrive before the
  /// zone is ready, and at least one message. 0: all at once, as soon as a landmark outside the zone is seen.
  int most_blocks = 5'000;
  // In multiples of the range that the robot sees:
  double zone_before = 0.75;  // how far before the robot the zone has its middle
  double look_ahead = 1.0;    // leaves so near to it are wanted in the zone,
  double zone_ahead = 1.35;   // and those so near are taken into the next one
};

/// All that is frozen: blocks of pairs of landmarks, of which one pair may have several, and the residual (2N).
struct FrozenInformation {
  struct Block {
    int slot, other;
    Eigen::Matrix2d Omega;
  };
  std::vector<Block> blocks;
  Eigen::VectorXd r;
};

/// The means of passive landmarks are those of mean(); the state holds old ones. At these means r is zero for all
/// passive landmarks that are not tied to groups.
class CondensationTree {
 public:
  CondensationTree(const CondensationOptions& options, const Pose2& start)
      : options_(options), tree_(start) {}

  /// Before a scan is processed: moves the landmarks that it sees into the window, with their present means. Removes
  /// from `slots` those that must wait, because the zone is moving to them or away from them. `range`: of the
  /// farthest observation [m]. False if a matrix is not positive definite, as below.
  [[nodiscard]] bool activate(InformationState& state, std::vector<int>& slots, double range);

  /// From now on nothing turns any more (CondensationOptions::turns).
  void keep_fixed() { options_.turns = false; }
  bool turns() const { return options_.turns; }

  /// Sends all messages anew, without any group: the exact solution, at the cost of a pass over the map.
  [[nodiscard]] bool solve_all(InformationState& state);

  /// Landmarks that have just joined the map and stay in the zone for ever, at known places: before all others.
  /// What is known of the places is added to the zone, where it does not turn.
  void hold(const InformationState& state, std::span<const int> slots, double sd);

  /// A landmark that has just joined the map, before it becomes active.
  void join(const InformationState& state, int slot);

  /// Moves the means of robot and active landmarks to the exact solution, and all others with them.
  [[nodiscard]] bool solve_window(InformationState& state);

  /// The factor of the last solve_window().
  const WindowFactor& window_factor() const { return factor_; }

  /// After landmarks have left the window, with what was frozen with them.
  [[nodiscard]] bool freeze(const InformationState& state, std::span<const FrozenPiece> pieces);

  /// After the last solve_window() of an update; without it the zone never moves, unless most_blocks is 0.
  /// Until the next activate() no mean of a landmark may change, except by rounding.
  void end_update(const InformationState& state);

  /// p_world_landmark, in O(log N). [m]
  Eigen::Vector2d mean(const InformationState& state, int slot) const;

  // For landmarks in the zone, directly after solve_window():

  bool is_in_zone(int slot) const { return landmark(slot).zone_index != none; }
  template <class Visit>
  void for_each_in_zone(Visit&& visit) const {
    for (int h = 0; h < zone_.size(); ++h) visit(zone_.slot(h));
  }
  /// What is frozen says where its landmarks are now, without any group. Off the live path.
  FrozenInformation frozen_information(const InformationState& state) const;

  /// The covariance of [pose | landmarks], from (Omega + S)^-1 and from how inactive landmarks follow, to `out`
  /// (3+2m x 3+2m).
  void covariance(const InformationState& state, std::span<const int> slots,
                  Eigen::Ref<Eigen::MatrixXd> out) const;

  /// Asks that the next zone hold this landmark.
  void want(int slot) { wanted_.push_back(slot); }

  std::int64_t blocks_touched() const { return blocks_touched_ + zone_.blocks_touched(); }
  /// Ignored observations of known landmarks that had to wait, so far. [-]
  std::int64_t waited() const { return waited_; }
  std::size_t memory_bytes() const;

  /// The first broken invariant of the tree, if any, at the cost of a pass over the map.
  std::optional<std::string> broken_invariant(const InformationState& state) const;

 private:
  static constexpr int none = -1;
  static constexpr int most_bare = 8;  // [-] leaves below a node that condenses nothing
  using Node = CondensationNode;
  CondensedLandmark& landmark(int slot) { return landmarks_[static_cast<std::size_t>(slot)]; }
  const CondensedLandmark& landmark(int slot) const { return landmarks_[static_cast<std::size_t>(slot)]; }
  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  const SentMessage& sent(int at) const { return at == tree_.hub() ? to_zone_ : node(at).sent; }
  template <class Visit>
  void for_each_landmark(int leaf, Visit&& visit) const {
    for (int slot = node(leaf).first_landmark; slot != none; slot = landmark(slot).next) visit(slot);
  }

  // The first broken invariant of one part, if any.
  std::optional<std::string> broken_landmark(int slot) const;
  int count_leaves(int slot) const;
  std::optional<std::string> broken_message(int at) const;
  std::optional<std::string> broken_group(int group, int at) const;

  // Planning.
  Eigen::Vector2d zone_middle(const Pose2& pose) const;
  void note_homes(const InformationState& state);
  void note_travel(const InformationState& state);
  int slices() const;
  bool choose_hot_leaves(const InformationState& state, std::span<const int> slots);
  void add_last_used(int landmarks);
  void begin_plan(const InformationState& state);
  int mark_plan();
  void begin_plan_of_all(const InformationState& state);
  void prepare_plan(const InformationState& state, int hub);
  void put_in_order(int at);
  bool is_stale(int at) const { return node(at).stale_in == plan_.number; }
  const SentMessage& next_of(int at) const;
  void mark_changed_leaves();
  void mark_stale(int at);
  void mark_expired(int at);
  void note_groups(int at);
  void note_group_places(int at);

  // Sending.
  bool work_on_plan(InformationState& state);
  bool make_ready(std::int64_t most_blocks);
  bool send(int from);
  void gather(int at);
  void add_message(const Condensed& message, bool is_new);
  void add_element(int leaf);
  bool is_complete(int at, FrontVariable v, int balance) const;
  bool condense(int at, SentMessage& next);

  // Grouping.
  double distance_ratio(int group);
  void tie_front(int at, SentMessage& next);
  void begin_group(int target);
  void tie(std::size_t index, int target, std::vector<int>& groups);
  void note_reach(int at, SentMessage& next);
  int count_unknowns(double ratio);
  int group_for(FrontVariable v, double ratio);
  int node_of(FrontVariable v) const;

  // Switching.
  void tell_residuals(const InformationState& state);
  bool move_zone(InformationState& state);
  void switch_leaves();
  void tell_residual(int at);
  void replace(int at);
  void settle(FrontVariable v, int at);
  void condense_residual(int at, Condensed& message);
  void add_part_residuals(int at);
  void forget(SentMessage& sent);
  bool fill_zone(InformationState& state);
  void take_into_zone(int slot, int h);
  void anchor_zone();
  void add_to_zone(const FrozenPiece& piece);
  void bring_to_zone(const FrozenPiece& piece);
  int owner_of(const FrozenPiece& piece);
  void add_to_element(const FrozenPiece& piece);
  void reserve_boundary(Eigen::Index rows);
  Eigen::VectorXd::SegmentReturnType residual_of(const Condensed& part);

  // The live path.
  int leaf_for(const Eigen::Vector2d& p, const Eigen::Vector2d& home);
  int add_leaf(const Eigen::Vector2d& p_world);
  void attach(int leaf);
  bool is_ready(int slot) const;
  void add_condensed(const InformationState& state, Eigen::Ref<Eigen::MatrixXd> Omega) const;
  void follow_in_zone(const InformationState& state);
  int settled_at(FrontVariable v) const;
  const Eigen::VectorXd& read_zone(const InformationState& state) const;
  void read(const InformationState& state, int at) const;
  void read_mean(FrontVariable v, double* mean) const;
  BodyMotion find_step(const Condensed& message) const;
  // Places.
  Eigen::Vector2d plan_place(FrontVariable v) const {
    return is_group(v) ? node(~v).group.place : landmark(v).place;
  }
  Eigen::Vector2d place(FrontVariable v, const double* mean) const;
  Eigen::Vector2d present_place(FrontVariable v) const;
  BodyMotion step_of(const Condensed& message, Eigen::Ref<Eigen::VectorXd> d) const;
  MovedPlace moved_place(FrontVariable v, const double* reference, const Eigen::Vector2d& now,
                         double turn) const;
  Eigen::Vector2d lever_step(const Eigen::Vector2d& lever, double turn) const;
  void turn_group(const BodyMotion& motion, const LandmarkGroup& group) const;
  BodyMotion motion_in_zone(const Condensed& element) const;
  void add_element(const InformationState& state, const Condensed& element, FrozenInformation& all) const;
  void bring_piece(std::span<const MovedPlace> places, FrozenPiece& piece) const;
  void note_places(const InformationState& state, int hub);
  void note_place(const InformationState& state, FrontVariable v);
  void note_places_of_groups(const InformationState& state, int at);
  void note_places_of_sources(const InformationState& state, int at);
  void note_places_of(const InformationState& state, Condensed& part);
  void carry_element(const InformationState& state, Condensed& element);
  void list_places(const Condensed& part);
  void bring_zone();
  void carry_window(InformationState& state);
  /// Two landmarks that are seen at the same time are nearer. [m]
  double near() const { return 2.0 * view_; }

  CondensationOptions options_;
  Homes homes_;
  LeafTree tree_;
  Front front_;  // before what holds its arrays
  ChunkedArray<Node> nodes_;
  ChunkedArray<CondensedLandmark> landmarks_;  // by slot
  HotZone zone_;
  SentMessage to_zone_;  // by the hub
  CondensationPlan plan_;
  std::vector<int> hot_leaves_;
  struct Held {
    int slot;
    Eigen::Vector2d at;  // p_world [m]
  };
  std::vector<Held> held_;
  int held_leaf_ = none;      // beside the tree; always hot
  double held_weight_ = 0.0;  // [1/m^2]
  std::vector<int> changed_;  // leaves that will have become hot or cold, or are new
  std::vector<int> zone_indices_;
  std::vector<int> wanted_;            // slots
  mutable Eigen::MatrixXd by_factor_;  // scratch (w x 3+2m), with room to grow
  double view_ = 0.0;                  // how far the robot sees [m]
  double travel_ = 0.0;                // how far the middle of the zone goes in an update [m]
  Eigen::Vector2d last_middle_ = Eigen::Vector2d::Zero();
  std::int64_t epoch_ = 1;
  std::int64_t zone_followed_at_ = 0;  // epoch, as below
  mutable std::int64_t zone_read_at_ = 0;
  mutable Eigen::VectorXd zone_read_, read_step_;  // with room to grow [m]
  int scan_ = 0, visit_ = 0;
  bool groups_allowed_ = true;      // to be begun
  int fronts_ = 0, counts_ = 0;     // [-] so far: marks of groups
  bool any_present_ = false;        // groups in the front, by what others have sent
  std::vector<int> targets_;        // by variable of the front: the node whose group it is tied to, or none
  Eigen::MatrixXd M_;               // (w x w), with room to grow
  mutable MovedBoundary boundary_;  // of the part that is being looked at, as the next three
  std::vector<MovedPlace> places_;
  FrozenPiece piece_;
  Eigen::VectorXd part_step_, part_residual_;  // with room to grow
  mutable Eigen::MatrixX2d V_;                 // of a piece, with room to grow
  ElementMover element_mover_;
  Eigen::VectorXd step_, change_;  // (w), with room to grow
  WindowFactor factor_;
  std::int64_t blocks_touched_ = 0, waited_ = 0;
};

}  // namespace seif
