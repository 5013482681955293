// Solves for robot and active landmarks with all that is known of the others.
#pragma once

#include <Eigen/Core>
#include <span>

#include "seif/information_state.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/hot_zone.hpp"
#include "seif/window_factor.hpp"

namespace seif {

class WindowSolution {
 public:
  WindowSolution(const CondensationRecords& records, const HotZone& zone) : records_(records), zone_(zone) {}

  /// Moves the means of robot and active landmarks. False if a matrix is not positive definite.
  [[nodiscard]] bool solve(InformationState& state);
  /// Of the last solve().
  const WindowFactor& factor() const { return factor_; }
  /// Of [pose | landmarks of the zone], to `out` (3+2m x 3+2m), directly after solve().
  void covariance(const InformationState& state, std::span<const int> slots,
                  Eigen::Ref<Eigen::MatrixXd> out) const;

 private:
  int index(int slot) const { return records_.landmark(slot).zone_index; }
  void add_zone(const InformationState& state, Eigen::Ref<Eigen::MatrixXd> Omega) const;
  void add_residual(const InformationState& state, Eigen::Ref<Eigen::VectorXd> r) const;
  void reserve(Eigen::Index rows);
  void set_columns(const InformationState& state, std::span<const int> slots,
                   Eigen::Ref<Eigen::MatrixXd> Y) const;

  const CondensationRecords& records_;
  const HotZone& zone_;
  WindowFactor factor_;
  Eigen::MatrixXd M_;                  // (w x w), with room to grow
  Eigen::VectorXd step_, change_;      // (w), with room to grow
  mutable Eigen::MatrixXd by_factor_;  // scratch (w x 3+2m), with room to grow
};

}  // namespace seif
