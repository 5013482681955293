// Which leaves are to be hot next.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/homes.hpp"
#include "seif/tree/moved_boundary.hpp"

namespace seif {

class ZoneChoice {
 public:
  explicit ZoneChoice(CondensationRecords& records) : records_(records) {}

  /// At the begin of a scan, which sees the landmarks `slots`, the farthest of them in `range` [m].
  void begin_scan(const InformationState& state, std::span<const int> slots, double range);
  int scan() const { return scan_; }

  /// Asks that the next zone hold this landmark. Until choose().
  void want(int slot) { wanted_.push_back(slot); }

  /// Of a zone of so many landmarks. False if it may stay as it is. Otherwise `chosen` are the leaves of the landmarks
  /// that are active, seen or wanted, those near the robot, and those last used that still have room beside them.
  bool choose(const InformationState& state, std::span<const int> slots, int zone_size,
              std::vector<int>& chosen);

  /// Whether active landmarks have moved so far against one another since the latest plan began that messages must
  /// be turned anew: a round has closed.
  bool is_bent(const InformationState& state);

  /// From where a landmark is to its home. [m]
  const Eigen::Vector2d& home_offset() const { return homes_.offset(); }
  /// Updates in which the robot comes to see what has called for the next zone. [-]
  double updates_to_arrive() const;

 private:
  Eigen::Vector2d middle(const Pose2& pose) const;
  void note_travel(const InformationState& state);
  void want_leaf(int leaf, std::vector<int>& chosen);
  void want_near(const InformationState& state, double views, std::vector<int>& chosen);
  void add_last_used(std::vector<int>& chosen);

  CondensationRecords& records_;
  Homes homes_;
  MovedBoundary boundary_;
  std::vector<MovedPlace> places_;
  std::vector<int> wanted_;  // slots
  int scan_ = 0;
  int landmarks_ = 0;    // [-] of the leaves that are chosen
  double travel_ = 0.0;  // how far the middle of the zone goes in an update [m]
  Eigen::Vector2d last_middle_ = Eigen::Vector2d::Zero();
};

}  // namespace seif
