#include "seif/measurement_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "seif/association/local_belief.hpp"
#include "seif/linearisation.hpp"

namespace seif {

double sd_of_sighting(const Observation& observation) {
  const Eigen::Matrix2d& Q = observation.covariance;
  return std::sqrt(std::max(Q(0, 0), observation.range * observation.range * Q(1, 1)));
}

bool is_closing(const InformationState& state, int slot, const Observation& observation,
                const Pose2& T_robot_sensor, double closing_gate) {
  if (closing_gate <= 0.0) return false;
  const Eigen::Vector2d seen_at =
      invert_observation(state.pose(), T_robot_sensor, observation).p_world_landmark;
  const double apart = (seen_at - state.mean(slot)).norm();
  constexpr double most_sigmas = 3.0;  // [sigma]
  return apart > closing_gate * observation.range && apart > most_sigmas * sd_of_sighting(observation);
}

void linearise_known(const InformationState& state, const Scan& scan, const Pose2& T_robot_sensor,
                     double closing_gate, std::vector<ObservationFactor>& factors) {
  factors.clear();
  for (const Observation& observation : scan.observations) {
    const std::optional<int> slot = state.find(observation.landmark);
    if (!slot || state.position(*slot) < 0) continue;
    factors.push_back(is_closing(state, *slot, observation, T_robot_sensor, closing_gate)
                          ? linearise_at_measurement(state, *slot, observation, T_robot_sensor)
                          : linearise(state, *slot, observation, T_robot_sensor));
  }
}

bool is_stale(const InformationState& state, const ObservationFactor& factor, const ObservationFactor& now,
              double relinearise_above) {
  Eigen::Vector2d nonlinearity = now.v - residual(state, factor);
  nonlinearity(1) = wrap_angle(nonlinearity(1));
  if (squared_norm(nonlinearity, factor) > relinearise_above * relinearise_above) return true;
  constexpr double sharper = 1.2;  // [-]
  return ((sharper * covariance(now)).diagonal().array() < covariance(factor).diagonal().array()).any();
}

void subtract_all(InformationState& state, std::span<const ObservationFactor> factors) {
  for (const ObservationFactor& factor : factors) subtract(state, factor);
}

void add_again(InformationState& state, const Pose2& T_robot_sensor, std::span<ObservationFactor> factors) {
  for (ObservationFactor& factor : factors) {
    const Eigen::Vector2d noise = factor.noise;
    factor = linearise(state, factor.slot, factor.observation, T_robot_sensor);
    set_noise(factor, noise);
    add(state, factor);
  }
}

void add_equal(InformationState& state, const std::vector<std::pair<int, int>>& equal_slots) {
  for (const auto& [a, b] : equal_slots) {
    if (state.position(a) < 0 || state.position(b) < 0) continue;
    const Eigen::Vector2d apart = state.mean(a) - state.mean(b);
    Eigen::Vector2d lever = Eigen::Vector2d::Zero();
    if (state.first_estimates().in_use())
      lever = seif::lever(state, a, state.mean(a)) - seif::lever(state, b, state.mean(b));
    Eigen::Matrix<double, 2, 7> J;  // wrt [x y theta a b]
    J << Eigen::Matrix2d::Zero(), Eigen::Vector2d(lever.y(), -lever.x()), Eigen::Matrix2d::Identity(),
        -Eigen::Matrix2d::Identity();
    const int row_a = InformationState::row_of(state.position(a));
    const int row_b = InformationState::row_of(state.position(b));
    const std::array rows{0, 1, 2, row_a, row_a + 1, row_b, row_b + 1};
    constexpr double weight = 1.0 / (equal_sd * equal_sd);
    state.Omega()(rows, rows) += weight * (J.transpose() * J);
    state.r()(rows) -= weight * (J.transpose() * apart);
    state.touch(6);
  }
}

}  // namespace seif
