// The block-sparse information form of the belief over robot and map.
//
//                  robot    active       passive
//   Omega = robot   [ xx     x,act        0        ]
//           active  [ ...    act,act      act,pas  ]
//           passive [ 0      ...          pas,pas  ]
//
// Robot and active landmarks (those with a link to the robot) are the window. Its matrix is dense, and no step
// changes anything outside it. The rest is a graph of 2 x 2 blocks, each stored once.
// The state keeps r = xi - Omega mu instead of xi: no large numbers cancel, and moving the mean by d is exact.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seif/first_estimates.hpp"
#include "seif/information_graph.hpp"
#include "seif/landmark_index.hpp"
#include "seif/types.hpp"

namespace seif {

class InformationState {
 public:
  /// A robot that knows no landmark. Throws std::invalid_argument if the covariance is not positive definite.
  explicit InformationState(const PoseEstimate& start);

  // The window. Rows [x y theta | active landmark 0 | 1 | ...]; w = window_size() = 3 + 2 active_count().
  int active_count() const { return static_cast<int>(active_.size()); }
  int window_size() const { return 3 + 2 * active_count(); }
  static int row_of(int position) { return 3 + 2 * position; }
  auto Omega() { return Omega_.topLeftCorner(window_size(), window_size()); }  // (w x w), symmetric
  auto Omega() const { return Omega_.topLeftCorner(window_size(), window_size()); }
  /// What is frozen among the active landmarks, if it is kept apart: Omega() is without it. (w x w)
  auto frozen() { return frozen_.topLeftCorner(window_size(), window_size()); }
  auto frozen() const { return frozen_.topLeftCorner(window_size(), window_size()); }
  auto r() { return r_.head(window_size()); }  // (w x 1)
  auto r() const { return r_.head(window_size()); }

  /// Scratch memory for a step, as large as the window, so that no step allocates.
  auto work() { return work_.topLeftCorner(window_size(), window_size()); }           // (w x w)
  auto work_columns() { return work_columns_.topRows(window_size()); }                // (w x 3)
  auto work_columns(int n) { return wide_columns_.topLeftCorner(window_size(), n); }  // (w x n), n <= 2w

  Pose2 pose() const { return {mu_(0), mu_(1), mu_(2)}; }
  void set_pose(const Pose2& pose) { mu_.head<3>() << pose.x, pose.y, pose.theta; }  // the caller updates r
  /// Not in use by default: Jacobians are then taken at the mean (linearisation.hpp).
  FirstEstimates& first_estimates() { return first_estimates_; }
  const FirstEstimates& first_estimates() const { return first_estimates_; }

  /// The slot of the active landmark at a position of the window.
  int active(int position) const { return active_[static_cast<std::size_t>(position)]; }
  /// The position of a landmark in the window, or -1 if it is passive.
  int position(int slot) const { return graph_.landmark(slot).position; }

  // The map. A slot is a landmark's number in the order in which it joined.
  int landmark_count() const { return graph_.landmark_count(); }
  std::optional<int> find(LandmarkId landmark) const { return index_.find(landmark); }
  LandmarkId id(int slot) const { return graph_.landmark(slot).id; }
  Eigen::Vector2d mean(int slot) const;         // p_world_landmark [m]
  Eigen::Vector2d residual(int slot) const;     // r_i
  Eigen::Matrix2d information(int slot) const;  // Omega_ii

  /// How many scans ago a landmark was last seen. [-] 0: in the latest scan.
  int scans_since_seen(int slot) const { return scan_ - graph_.landmark(slot).last_seen; }
  int sightings(int slot) const { return graph_.landmark(slot).sightings; }           // [-] scans that saw it
  bool has_link(int slot) const { return graph_.landmark(slot).first_link != none; }  // to a passive landmark
  void begin_scan() { ++scan_; }
  void mark_seen(int slot);

  /// From now on Omega() and r() hold only what is not frozen yet (freezing.hpp). Before the first landmark joins.
  void keep_frozen_apart() { keeps_frozen_apart_ = true; }
  bool keeps_frozen_apart() const { return keeps_frozen_apart_; }

  /// Adds a passive landmark without information. Returns its slot. If it is settled, its first estimate stays.
  int add_landmark(LandmarkId landmark, const Eigen::Vector2d& mean, bool is_settled = false);

  /// Takes a passive landmark into the window; returns its position there.
  int activate(int slot);

  /// Takes the landmark at `position`, which has no link to the robot, out of the window. The last one moves there.
  void deactivate(int position);

  /// Calls visit(other slot, Omega_so) for every link of a landmark, except for the links within the window.
  template <class Visit>
  void for_each_neighbour(int slot, Visit&& visit) const {
    const bool is_active = position(slot) != none;
    graph_.for_each_link(slot, [&](int link, int end, int other) {
      if (!is_active || position(other) == none) visit(other, graph_.block(link, end));
    });
  }

  // Each of these moves means by d and keeps r exact, for the moved and for all linked landmarks.
  void move_robot(const Eigen::Vector3d& d);
  void move_landmark(int slot, const Eigen::Vector2d& d);
  void move_window(const Eigen::Ref<const Eigen::VectorXd>& d);  // (w x 1)

  /// The same if all passive landmarks follow so that their own r stays: the window's r loses `dr` (w x 1), no
  /// other r changes, and the caller updates the means of the passive landmarks.
  void move_window(const Eigen::Ref<const Eigen::VectorXd>& d, const Eigen::Ref<const Eigen::VectorXd>& dr);
  /// Sets the mean of a passive landmark; the caller must update r.
  void set_mean(int slot, const Eigen::Vector2d& mean);

  /// Keeps squared_residual() up to date wherever r changes. Before the first landmark joins.
  void track_residual() { tracks_residual_ = true; }
  /// Sum of r_i' Omega_ii^-1 r_i [-], in constant time. Nothing if the robot's block is not positive definite.
  std::optional<double> squared_residual() const;
  /// The report's count: links of the robot + pairs of linked landmarks.
  std::int64_t link_count() const;

  /// Blocks read or written so far. Whoever works on the window adds its blocks with touch().
  std::int64_t blocks_touched() const { return blocks_touched_; }
  void touch(std::int64_t blocks) { blocks_touched_ += blocks; }
  /// The number of distinct blocks in the window.
  std::int64_t window_blocks() const { return std::int64_t{active_count() + 1} * (active_count() + 2) / 2; }

  std::size_t memory_bytes() const;

 private:
  using Block = InformationGraph::Block;
  using Landmark = InformationGraph::Landmark;
  static constexpr int none = InformationGraph::none;

  Eigen::MatrixXd& stored() { return keeps_frozen_apart_ ? frozen_ : Omega_; }
  void load_into_window(int slot, int position);
  void store_from_window(int position);
  void move_within_window(int from, int to);
  void reserve_window(int active_landmarks);
  void note_residual(Landmark& landmark);

  std::vector<int> active_;              // slots, by position
  Eigen::MatrixXd Omega_, frozen_;       // window, with room to grow
  Eigen::VectorXd mu_, r_;               // window
  Eigen::MatrixXd work_, wide_columns_;  // as large as Omega_, and twice as wide
  Eigen::Matrix<double, Eigen::Dynamic, 3> work_columns_;
  Eigen::MatrixXi link_of_;  // by two positions: the graph's link between them, or none (symmetric)

  InformationGraph graph_;
  LandmarkIndex index_;
  FirstEstimates first_estimates_;
  int scan_ = 0;
  bool keeps_frozen_apart_ = false, tracks_residual_ = false;
  double squared_residual_ = 0.0;  // sum over the passive landmarks
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
