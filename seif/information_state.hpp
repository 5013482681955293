// The block-sparse information form of the belief over robot and map.
//
//                    robot  active        passive
//           robot  [ xx     x,act         0           ]     The window, dense: the robot and the landmarks
//           that are
//   Omega = active [ ...    act,act       act,passive ]     linked to it. All that motion, measurement and
//           passive[ 0      ...           pas,pas     ]     sparsification change lies in it.
//                                                           The rest is a graph of 2 x 2 blocks, each stored
//                                                           once.
//
// Instead of xi it keeps the residual r = xi - Omega mu. Large numbers then do not cancel, turning the
// heading by a full circle changes nothing, and moving the mean by d is exact: r -= Omega d. xi = r + Omega
// mu where it is wanted.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/first_estimate_frame.hpp"
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
  auto r() { return r_.head(window_size()); }  // (w x 1)
  auto r() const { return r_.head(window_size()); }

  /// Scratch for the steps, as large as the window, so that none of them allocates. Holds nothing between
  /// steps.
  auto work() { return work_.topLeftCorner(window_size(), window_size()); }        // (w x w)
  auto work() const { return work_.topLeftCorner(window_size(), window_size()); }  // (w x w)
  auto work_columns() { return work_columns_.topRows(window_size()); }             // (w x 3)

  Pose2 pose() const { return {mu_(0), mu_(1), mu_(2)}; }
  /// The mean of the pose as a motion predicts it; the caller keeps r. Returns by how much the pose that
  /// levers are taken from was moved [m].
  Eigen::Vector2d move_pose(const Pose2& pose);

  // What the steps take for the null space of what is observed: at the mean, or at first estimates.

  /// From now on moving and turning everything at once is taken to move the pose and the landmarks about
  /// their first estimates, a landmark's being where it was believed to be after `sightings` scans (at least
  /// one) that saw it, or as it gets its first link to a passive landmark. Then this motion is one and the
  /// same for all time, and nothing is learned of what nothing observes: Huang, Mourikis, Roumeliotis,
  /// "Observability-based rules for designing consistent EKF SLAM estimators", IJRR 2010. The pose's is where
  /// its prediction stands among the first estimates (pose_among()); once the map has moved as a whole, as at
  /// the end of a loop, the prediction itself would not fit to them. Nor would a new landmark's mean, so its
  /// first estimate is put where it is from there. Before the first landmark joins.
  void use_first_estimates(int sightings) { settled_after_ = sightings; }
  bool uses_first_estimates() const { return settled_after_ > 0; }

  /// The pose among the first estimates, and where a landmark is among them.
  Pose2 linearisation_pose() const { return uses_first_estimates() ? linearisation_pose_ : pose(); }
  Eigen::Vector2d linearisation_point(int slot) const;
  /// Where the pose is among the first estimates of active landmarks that it does not fit to, as along the
  /// seam of a loop that was closed: from one of these. Nothing if it fits to all.
  std::optional<Pose2> other_linearisation_pose() const;

  /// From the pose to a landmark taken to be at p_world_landmark, where steps are to linearise [m]. That
  /// between the first estimates wherever it stands for it.
  Eigen::Vector2d lever(int slot, const Eigen::Vector2d& p_world_landmark) const;

  /// How far from where a landmark is the latest scan may have seen it (one sigma, the largest) [m]: by this
  /// stands_for() judges. Before it is told, all first estimates stand.
  void note_sighting_sd(double sighting_sd) { sighting_sd_ = sighting_sd; }

  /// Takes the present means for the first estimates of active landmarks that are not settled yet. What is
  /// known stays known of the motion about the new ones.
  void update_first_estimates();

  /// The slot of the active landmark at a position of the window.
  int active(int position) const { return active_[static_cast<std::size_t>(position)]; }
  /// The position of a landmark in the window, or -1 if it is passive.
  int position(int slot) const { return landmarks_[index(slot)].position; }

  // The map. A slot is a landmark's number in the order in which it joined.
  int landmark_count() const { return static_cast<int>(landmarks_.size()); }
  std::optional<int> find(LandmarkId landmark) const { return index_.find(landmark); }
  LandmarkId id(int slot) const { return landmarks_[index(slot)].id; }
  Eigen::Vector2d mean(int slot) const;         // p_world_landmark [m]
  Eigen::Vector2d residual(int slot) const;     // r_i
  Eigen::Matrix2d information(int slot) const;  // Omega_ii

  /// How many scans ago a landmark was last seen; 0: in the latest one.
  int scans_since_seen(int slot) const { return scan_ - landmarks_[index(slot)].last_seen; }
  void begin_scan() { ++scan_; }
  void mark_seen(int slot);

  /// Adds a passive landmark of which nothing is known yet: no information, no links. Returns its slot.
  int add_landmark(LandmarkId landmark, const Eigen::Vector2d& mean);

  /// Takes a passive landmark into the window; returns its position there.
  int activate(int slot);

  /// Takes the landmark at `position` out of the window; its link to the robot must be zero. The last active
  /// landmark moves to its place.
  void deactivate(int position);

  /// Calls visit(other slot, Omega_so) for every link of a landmark but those within the window.
  template <class Visit>
  void for_each_neighbour(int slot, Visit&& visit) const {
    const bool is_active = position(slot) != none;
    for_each_link(slot, [&](int link, int end, int other) {
      if (is_active && position(other) != none) return;
      const Block& stored = links_[index(link)].Omega_ij;
      visit(other, end == 0 ? stored : Block(stored.transpose()));
    });
  }

  /// Moves the mean of the robot by d (3 x 1) and keeps r exact.
  void move_robot(const Eigen::Vector3d& d);

  /// Moves the mean of one landmark by d (2 x 1) and keeps r exact at it and at all that is linked to it.
  void move_landmark(int slot, const Eigen::Vector2d& d);

  /// Moves the mean of the whole window by d (w x 1) and keeps r exact, in it and at the passive landmarks
  /// linked to it.
  void move_window(const Eigen::Ref<const Eigen::VectorXd>& d);

  /// The same where all passive landmarks follow, each to where its own r stays: the window's r loses `dr`
  /// (w x 1), no other r changes, and the caller keeps the means of the passive landmarks.
  void move_window(const Eigen::Ref<const Eigen::VectorXd>& d, const Eigen::Ref<const Eigen::VectorXd>& dr);

  /// The mean of a passive landmark; the caller keeps r.
  void set_mean(int slot, const Eigen::Vector2d& mean);

  /// From now on squared_residual() is kept up to date wherever r changes. Before the first landmark joins.
  void track_residual() { tracks_residual_ = true; }
  /// Sum of r_i' Omega_ii^-1 r_i over the robot and all landmarks, in constant time. [-]
  double squared_residual() const;

  /// The report's count: links of the robot + pairs of landmarks with a link.
  std::int64_t link_count() const;

  /// Blocks read or written so far; those who work on the window add what they touch.
  std::int64_t blocks_touched() const { return blocks_touched_; }
  void touch(std::int64_t blocks) { blocks_touched_ += blocks; }
  /// The number of distinct blocks in the window.
  std::int64_t window_blocks() const { return std::int64_t{active_count() + 1} * (active_count() + 2) / 2; }

  std::size_t memory_bytes() const;

  // Off the live path: all of it, at the cost of a pass over the map.
  Eigen::SparseMatrix<double> full_Omega() const;  // (3+2N x 3+2N), lower triangle
  Eigen::VectorXd full_mu() const;                 // (3+2N x 1)
  Eigen::VectorXd full_r() const;                  // (3+2N x 1)
  /// Moves the whole mean by d (3+2N x 1), for instance by the exact solution of Omega d = r.
  void move_all(const Eigen::VectorXd& d);

 private:
  using Block = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;
  using Point = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  static constexpr int none = -1;

  /// While a landmark is active, its mean, residual and information stand in the window, and those here are
  /// stale.
  struct Landmark {
    LandmarkId id = no_landmark;
    int position = none;    // in the window
    int first_link = none;  // head of its list of links
    int last_seen = 0;      // number of the scan
    int sightings = 0;      // [-] scans that saw it
    Point mu = Point::Zero();
    Point first_estimate = Point::Zero();
    Point r = Point::Zero();
    Block Omega_ii = Block::Zero();
    double squared_residual = 0.0;  // r' Omega_ii^-1 r if tracked
  };

  /// A block Omega_ij, stored once and threaded through the lists of both its ends. While both are active the
  /// block stands in the window, and this one is stale.
  struct Link {
    int end[2] = {none, none};   // slots i, j
    int next[2] = {none, none};  // the next link in the list of i, of j
    Block Omega_ij = Block::Zero();
  };

  static std::size_t index(int slot) { return static_cast<std::size_t>(slot); }
  /// Calls visit(link, end, other) for each link of a landmark: end is which end of the link it is, other the
  /// slot at the far end.
  template <class Visit>
  void for_each_link(int slot, Visit&& visit) const {
    for (int link = landmarks_[index(slot)].first_link; link != none;) {
      const Link& l = links_[index(link)];
      const int end = l.end[0] == slot ? 0 : 1;
      const int next = l.next[end];
      visit(link, end, l.end[1 - end]);
      link = next;
    }
  }
  int add_link(int slot_i, int slot_j, const Block& Omega_ij);
  void set_link(int link, int slot_i, const Block& Omega_ij);
  void load_into_window(int slot, int position);
  void store_from_window(int position);
  void move_within_window(int from, int to);
  void reserve_window(int active_landmarks);
  void note_residual(Landmark& landmark);
  Eigen::Vector2d first_lever(int slot) const;  // between first estimates
  Eigen::Vector2d among_first_estimates(const Eigen::Vector2d& p_world) const;
  void move_first_estimate(int position, const Eigen::Vector2d& to);

  std::vector<int> active_;  // slots, by position
  Eigen::MatrixXd Omega_;    // window, with room to grow
  Eigen::VectorXd mu_;       // window
  Eigen::VectorXd r_;        // window
  Eigen::MatrixXd work_;     // as large as Omega_
  Eigen::Matrix<double, Eigen::Dynamic, 3> work_columns_;
  Eigen::MatrixXi link_of_;  // by two positions: the link in the graph between them, or none (symmetric)

  ChunkedArray<Landmark> landmarks_;
  ChunkedArray<Link> links_;
  LandmarkIndex index_;
  int settled_after_ = 0;  // [-] sightings; 0: Jacobians at the mean
  Pose2 linearisation_pose_;
  double sighting_sd_ = std::numeric_limits<double>::infinity();  // [m]
  std::vector<FirstEstimate> first_estimates_;                    // scratch, of the active landmarks
  int scan_ = 0;
  bool tracks_residual_ = false;
  double squared_residual_ = 0.0;  // of the passive landmarks
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
