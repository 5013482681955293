#include "worlds/describe_sensors.hpp"

#include <array>
#include <string_view>

#include "worlds/describe_parts.hpp"

namespace worlds {
namespace {

constexpr double smallest_angle_sd = 1e-5;     // [deg] logs allow 1e-7 rad
constexpr double largest_angle_sd = 180;       // [deg]
constexpr double largest_mount_offset = 10;    // [m]
constexpr double most_false_detections = 100;  // [-] in a scan, on average; all of them may be linked

constexpr std::array<std::string_view, 2> landmark_ids_names = {"known", "hidden"};

}  // namespace

void describe_encoders(Fields& fields, Encoders& encoders) {
  fields.integer("rate_hz", encoders.rate, between(1, highest_step_rate),
                 "odometry; divides physics.step_rate_hz");
  fields.integer("ticks_per_revolution", encoders.ticks_per_revolution, between(0, 1e9),
                 "resolution; 0: no quantisation");
  fields.number("distance_sd_m_per_sqrt_m", encoders.distance_sd, between(0, 10),
                "random error of one wheel after 1 m rolled");
  fields.number("diameter_ratio", encoders.diameter_ratio, between(0.5, 2),
                "right over left wheel diameter, actual over assumed");
  fields.number("track_ratio", encoders.track_ratio, between(0.5, 2), "actual over assumed track");
  fields.number("diameter_ratio_sd", encoders.diameter_ratio_sd, between(0, 0.1),
                "standard deviation of the part of the diameter ratio that is drawn from the seed");
  fields.number("track_ratio_sd", encoders.track_ratio_sd, between(0, 0.1),
                "standard deviation of the part of the track ratio that is drawn from the seed");
  fields.boolean("calibrated", encoders.calibrated, "no systematic error, whatever the ratios say");
}

void describe_landmark_sensor(Fields& fields, LandmarkSensor& sensor) {
  fields.integer("rate_hz", sensor.rate, between(1, highest_step_rate),
                 "scans; divides physics.step_rate_hz");
  fields.section(
      "mount", "where the sensor sits on the robot, from the middle of the axle",
      [&](Fields& inner) { describe_placement(inner, sensor.mount, Need::defaulted, largest_mount_offset); });
  fields.number("max_range_m", sensor.max_range, more_than_up_to(0, largest_ground),
                "largest distance to a landmark's centre at which it is seen");
  fields.angle("fov_deg", sensor.fov, more_than_up_to(0, 360), "full angle, centred on the sensor's x");
  fields.number("range_sd_m", sensor.range_sd, between(smallest_length, largest_range_sd),
                "standard deviation of a range");
  fields.number("range_sd_per_m", sensor.range_sd_per_m, between(0, 10),
                "what each metre of range adds to the standard deviation, in quadrature");
  fields.angle("bearing_sd_deg", sensor.bearing_sd, between(smallest_angle_sd, largest_angle_sd),
               "standard deviation of a bearing");
  fields.number("miss_probability", sensor.miss_probability, between(0, 1),
                "that a visible landmark is not reported");
  fields.number("false_detections_per_scan", sensor.false_detections, between(0, most_false_detections),
                "mean number (Poisson)");
  describe_choice(fields, "ids", sensor.ids, landmark_ids_names,
                  "whether an observation tells which landmark it is of; with hidden, ekf and seif find out "
                  "by themselves, "
                  "and estimators that cannot are left out");
  fields.number("misread_probability", sensor.misread_probability, between(0, 1),
                "that an observation bears another landmark's id");
}

void describe_sensors(Fields& fields, Encoders& encoders, LandmarkSensor& landmark_sensor) {
  fields.section("encoders", "wheel encoders", [&](Fields& item) { describe_encoders(item, encoders); });
  fields.section("landmark_sensor", "range and bearing of landmarks",
                 [&](Fields& item) { describe_landmark_sensor(item, landmark_sensor); });
}

void describe_start_estimate(Fields& fields, StartEstimate& start) {
  constexpr double largest_start_sd = 1e4;  // [m]
  const Range length = between(smallest_length, largest_start_sd);
  fields.number("x_sd_m", start.x_sd, length, "standard deviation of x");
  fields.number("y_sd_m", start.y_sd, length, "standard deviation of y");
  fields.angle("heading_sd_deg", start.heading_sd, between(smallest_angle_sd, largest_angle_sd),
               "standard deviation of the heading");
}

}  // namespace worlds
