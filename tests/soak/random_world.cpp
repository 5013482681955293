#include "random_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <string_view>
#include <vector>

namespace soak {

namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  std::string_view one_of(const std::vector<std::string_view>& all) {
    return all[static_cast<std::size_t>(whole(0, static_cast<int>(all.size()) - 1))];
  }

 private:
  std::mt19937_64 random_;
};

std::string landmarks(Dice& dice) {
  const std::string_view type = dice.one_of({"uniform", "poisson_disk", "clusters", "grid", "ring"});
  std::string keys = fmt::format("type: {}, max_tries: 2000, ", type);
  if (type == "grid") {
    keys += fmt::format("cell_m: [{0:.2f}, {0:.2f}], skip_blocked: true", dice.between(2.0, 6.0));
  } else if (type == "ring") {
    keys += fmt::format("count: {}, ring_radius_m: {:.2f}, skip_blocked: true", dice.whole(3, 40),
                        dice.between(3.0, 6.5));
  } else {
    keys += fmt::format("count: {}", dice.whole(1, 60));
  }
  return fmt::format("landmarks: {{generators: [{{{}}}]}}\n", keys);
}

std::string drive(Dice& dice) {
  const double reach = dice.between(1.0, 4.5);
  const double speed = dice.between(0.1, 1.0);
  switch (dice.whole(0, 3)) {
    case 0:
      return "drive: {mode: hold}\n";
    case 1:
      return fmt::format("drive: {{mode: explore, speed_m_s: {:.2f}}}\n", speed);
    case 2:
      return fmt::format(
          "drive: {{mode: serpentine, min_m: [-{0:.2f}, -{0:.2f}], max_m: [{0:.2f}, {0:.2f}], "
          "lane_m: {1:.2f}, speed_m_s: {2:.2f}}}\n",
          reach, dice.between(0.5, 3.0), speed);
    default:
      return fmt::format(
          "drive: {{mode: loop, waypoints_m: [[{0:.2f}, {0:.2f}], [-{0:.2f}, {0:.2f}], [-{0:.2f}, "
          "-{0:.2f}], [{0:.2f}, -{0:.2f}]], speed_m_s: {1:.2f}, pose_from: {2}}}\n",
          reach, speed, dice.one_of({"truth", "odometry", "ekf"}));
  }
}

std::string sensors(Dice& dice) {
  return fmt::format(
      "sensors:\n  encoders: {{rate_hz: {}, ticks_per_revolution: {}, distance_sd_m_per_sqrt_m: {:.4f}, "
      "diameter_ratio_sd: {:.4f}, track_ratio_sd: {:.4f}}}\n  landmark_sensor: {{rate_hz: {}, max_range_m: "
      "{:.2f}, "
      "fov_deg: {:.1f}, range_sd_m: {:.4f}, range_sd_per_m: {:.4f}, bearing_sd_deg: {:.4f}, "
      "miss_probability: {:.2f}, "
      "false_detections_per_scan: {:.2f}}}\n",
      dice.one_of({"10", "20", "60"}), dice.one_of({"0", "64", "4096"}), dice.between(0.0, 0.02),
      dice.between(0.0, 0.01), dice.between(0.0, 0.01), dice.one_of({"1", "5", "20"}),
      dice.between(1.0, 15.0), dice.between(30.0, 360.0), dice.between(0.001, 0.3), dice.between(0.0, 0.05),
      dice.between(0.01, 5.0), dice.chance(0.3) ? dice.between(0.0, 0.9) : 0.0,
      dice.chance(0.3) ? dice.between(0.0, 2.0) : 0.0);
}

std::string fault(Dice& dice, double duration) {
  const std::string at = fmt::format("at_s: {:.2f}", dice.between(0.0, duration));
  switch (dice.whole(0, 4)) {
    case 0:
      return fmt::format("{{kind: bad_observation, {}, value: {}}}", at,
                         dice.one_of({"not_a_number", "infinite", "absurd"}));
    case 1:
      return fmt::format("{{kind: outlier, {}, size_sigma: {:.1f}}}", at, dice.between(-30.0, 30.0));
    case 2:
      return fmt::format("{{kind: encoder_jump, {}, wheel: {}, jump_deg: {:.0f}}}", at,
                         dice.one_of({"left", "right"}), dice.between(-720.0, 720.0));
    case 3:
      return fmt::format("{{kind: silence, {}, sensor: {}, duration_s: {:.1f}}}", at,
                         dice.one_of({"landmark_sensor", "encoders"}), dice.between(0.1, 10.0));
    default:
      return fmt::format("{{kind: kidnapping, {}, x_m: {:.2f}, y_m: {:.2f}, heading_deg: {:.0f}}}", at,
                         dice.between(-6.0, 6.0), dice.between(-6.0, 6.0), dice.between(-180.0, 180.0));
  }
}

std::string estimators(Dice& dice) {
  std::string text = fmt::format("estimators:\n  ekf: {{gate: {}}}\n", dice.one_of({"0", "25"}));
  text += fmt::format("  seif: {{theta_x: {}, theta_max: {}, gate: {}, first_estimates: {}}}\n",
                      dice.whole(2, 8), dice.whole(8, 24), dice.one_of({"0", "25"}), dice.one_of({"0", "5"}));
  if (dice.chance(0.3)) text += fmt::format("  groups: {{type: seif, mean_recovery: multilevel}}\n");
  if (dice.chance(0.3)) text += fmt::format("  seif_report: {{theta_x: {}}}\n", dice.whole(2, 8));
  if (dice.chance(0.3)) text += "  eseif: {}\n";
  return text;
}

}  // namespace

std::string random_world(std::uint64_t seed) {
  Dice dice(seed);
  const bool kinematic = dice.chance(0.5);
  const double duration = dice.between(5.0, 30.0);
  std::string text =
      fmt::format("name: soak_{}\nseed: {}\nduration_s: {:.2f}\nground: {{size_m: [20, 20]}}\n", seed,
                  dice.whole(0, 1'000'000), duration);
  text += fmt::format("physics: {{engine: {}, friction: {:.2f}}}\n", kinematic ? "kinematic" : "bullet",
                      dice.between(0.1, 1.0));
  text += landmarks(dice) + drive(dice) + sensors(dice) + estimators(dice);
  if (!kinematic && dice.chance(0.5))
    text += fmt::format("obstacles: {{boxes: [{{x_m: {:.2f}, y_m: 8, size_m: [{:.2f}, 0.5]}}]}}\n",
                        dice.between(-6.0, 6.0), dice.between(0.2, 4.0));
  const int faults = dice.chance(0.5) ? dice.whole(1, 4) : 0;
  text += faults > 0 ? "faults:\n" : "";
  for (int i = 0; i < faults; ++i) text += fmt::format("  - {}\n", fault(dice, duration));
  return text + fmt::format("scoring: {{interval_s: {:.1f}}}\n", dice.between(1.0, 10.0));
}

}  // namespace soak
