// A filter for unknown association: names each observation before a filter with known association takes it in.
//
//   scan -> candidates near each observed position -> pairs -> named scan -> filter
//                                     nothing fits -> tentative -> a new landmark
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "seif/association/filter_around.hpp"
#include "seif/association/landmark_grid.hpp"
#include "seif/association/landmark_records.hpp"
#include "seif/association/local_belief.hpp"
#include "seif/association/tentative_landmarks.hpp"
#include "seif/estimator.hpp"
#include "seif/relocating/place_finder.hpp"

namespace seif {

struct AssociationOptions {
  bool jointly = true;  // JCBB, or each observation for itself
  /// [-] The probability that a correct pair is rejected.
  double match_probability = 1e-3;
  /// [-] An unpaired observation is taken for a new landmark only if a known one is this far away with at most this
  /// probability. Between the two gates an observation is ignored.
  double new_probability = 1e-6;
  /// [-] The probability that two landmarks which are one are not recognised, where only one of them is seen.
  double merge_probability = 1e-6;
  int admit_after = 3;    // [-] scans that saw it until a landmark joins the map
  int forget_after = 10;  // [-] scans that did not see it, until then, after which it is forgotten
  /// [-] Removes a landmark that was seen in less than this share of the scans that should have seen it.
  double remove_below = 0.05;
  /// [-] The probability of a wrong match that is as good as one by which a lost robot is put back.
  double wrong_place_probability = 1e-6;
  bool seeks_closings = true;  // among landmarks that are in the map already, beyond all gates
};

/// Names are 0, 1, 2, .. in the order in which landmarks join. Removed and merged landmarks stay in the filter's
/// belief, but not in its map, and are never observed again.
class AssociatingFilter final : public FilterAround {
 public:
  /// `make_local` makes filters of the same kind for the maps of a lost robot; without it the robot stays lost. Throws
  /// std::invalid_argument if the filter has no local belief.
  AssociatingFilter(std::unique_ptr<Estimator> filter, const EstimatorSetup& setup,
                    const AssociationOptions& options, LocalMap::MakeFilter make_local = {});

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  bool needs_names() const override { return false; }
  std::span<const LandmarkId> associations() const override { return names_; }
  Counts counts() const override;
  std::size_t memory_bytes() const override;
  void landmarks(std::span<const LandmarkId> landmarks, std::vector<LandmarkEstimate>& out) const override;
  void couplings(LandmarkId of, std::vector<Coupling>& out) const override;
  Eigen::MatrixXd whole_belief_matrix() const override;
  std::vector<LandmarkEstimate> map() const override;

 private:
  /// Two landmarks that may be one: only one of them is seen where both should be.
  struct Suspicion {
    LandmarkId a, b;
    int scans = 0;  // [-] that saw one of them; many below zero once both were seen at once
    int last_scan = 0;
  };
  struct Seen {
    Eigen::Vector2d p_world;  // [m] where the observation says that something is
    double variance;          // [m^2] of that, by the sensor's errors alone
    double radius_by_pose;    // [m] within which the landmark may be, as far as the pose is uncertain
  };
  bool is_seen_now(LandmarkId id) const { return records_[id].last_seen == scan_; }

  bool is_lost(const Scan& scan);
  double doubt_of(const Scan& scan) const;
  int pairs_found(int observed) const;
  bool is_paired(LandmarkId id, int observed) const;
  void look_for_place(const Scan& scan);
  void look_for_closing(double t);
  void close(const Closing& closing);
  void join(LandmarkId stays, LandmarkId goes);
  void rename(LandmarkId from, LandmarkId to);
  LandmarkId new_name(const Eigen::Vector2d& p_world);
  Eigen::Vector2d p_sensor(LandmarkId id) const;
  void refresh_grid();
  void find_pairs(const Scan& scan);
  void find_candidates(const Scan& scan, const Eigen::Matrix3d& P_x, std::size_t max_count);
  void gather_near(const Observation& observation, const Eigen::Matrix3d& P_x, std::size_t max_count);
  int number_of(LandmarkId id);
  bool want_near(const Seen& seen);
  void name(const Scan& scan);
  LandmarkId name_if_new(std::size_t observation);
  void note_expected();
  void suspect();
  void suspect(LandmarkId seen, LandmarkId other);
  bool may_be_one(int a, int b) const;
  void merge();
  void retire(LandmarkId id);
  void widen_view(const Scan& scan);

  LocalBelief& belief_;  // of filter_
  Pose2 T_robot_sensor_;
  AssociationOptions options_;
  ScanMatcher matcher_;
  double merge_gate_;  // [-]
  TentativeLandmarks tentative_;
  std::optional<LandmarkGrid> grid_;  // made once it is known how far the robot sees
  LandmarkRecords records_;
  std::vector<Suspicion> suspicions_;
  LocalMap::MakeFilter make_local_;
  std::optional<PlaceFinder> finder_;  // made with the grid, if the robot is to be found
  double doubt_ = 0.0;                 // [nat] that the robot is where the filter believes
  int last_home_ = 0;                  // the last scan that fitted
  int searched_ = 0, fitting_ = 0;     // [-] scans of this search; those in a row that fit again
  std::int64_t held_back_ = 0;         // [-] observations
  int scan_ = 0;
  double wander_ = 0.0;  // [m^2] since the last scan

  // What belongs to the latest scan; kept so that no update allocates.
  std::vector<LandmarkId> names_;  // by observation
  Scan named_;
  std::vector<LandmarkId> at_hand_, asked_, wanted_;
  std::vector<LandmarkGrid::Near> near_;
  struct Pair {
    int observation;
    int landmark;  // its number among asked_
  };
  std::vector<Pair> pairs_;  // of observations and landmarks near them
  std::vector<Seen> seen_;   // by observation
  std::int64_t blocks_touched_ = 0;
  Eigen::MatrixXd Sigma_;  // of [pose | asked_], with room to grow
  mutable std::vector<LandmarkId> looked_up_;
};

}  // namespace seif
