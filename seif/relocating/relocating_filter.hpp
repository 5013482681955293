// A filter that notices that it has lost its place, and finds it again in its map. Landmarks bear names.
//
//   scan -> does it fit to what is expected? -> yes: the filter
//                                            -> no: a local map -> which of its landmarks are in the map?
//                                                               -> where do they agree? -> the filter relocates
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "seif/association/filter_around.hpp"
#include "seif/association/sensor_view.hpp"
#include "seif/relocating/local_map.hpp"
#include "seif/relocating/placement.hpp"

namespace seif {

class RelocatingFilter final : public FilterAround {
 public:
  /// `make_local` makes filters for the local maps. Throws std::invalid_argument if the filter has no local belief.
  RelocatingFilter(std::unique_ptr<Estimator> filter, LocalMap::MakeFilter make_local,
                   const EstimatorSetup& setup);

  void motion_update(const Odometry& odometry) override;
  void measurement_update(const Scan& scan, const StageDone& done) override;
  Counts counts() const override;
  std::size_t memory_bytes() const override;

 private:
  enum class Verdict { fits, contradicts, says_nothing };

  bool is_near_expected(const Scan& scan) const;
  bool is_shut_out() const;
  void take_in(const Scan& scan, bool is_near, const StageDone& done);
  void forget_shut_out();
  Verdict judge(const Scan& scan);
  bool has_vanished(const Scan& scan);
  void begin_search();
  void end_search();
  void search(const Scan& scan);
  void follow(const Scan& scan);
  void pair_by_names();
  bool choose_most_that_agree(Placement& placement) const;
  std::optional<Placement> place(double t);
  void tell_filter(const Placement& placement, double t);
  void remember(const Scan& scan);

  LocalBelief& belief_;
  const Pose2 T_robot_sensor_;
  LocalMap local_;
  Surroundings surroundings_;
  std::vector<Pairing> known_;             // of the surroundings, in the map
  std::vector<Eigen::Vector2d> known_at_;  // [m] in the world
  bool has_doubt_ = false;                 // the filter gets empty scans
  int fitting_scans_ = 0;                  // [-] in a row, while in doubt
  std::int64_t held_back_ = 0;             // [-] observations
  int shut_out_scans_ = 0;                 // [-] by the filter's gate, in a row
  std::int64_t shut_out_ = 0;              // [-] observations of these
  SensorView view_;
  std::vector<LandmarkId> last_seen_;  // by the last scan that saw something
  Scan empty_;
  std::vector<LandmarkId> ids_;
  std::vector<LandmarkEstimate> found_;
  Eigen::MatrixXd Sigma_;  // scratch
};

}  // namespace seif
