#include "worlds/describe_fault.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/describe_parts.hpp"
#include "worlds/world.hpp"

namespace worlds {
namespace {

constexpr std::array<std::string_view, 9> kind_names = {
    "bad_observation", "outlier", "encoder_jump", "silence", "kidnapping", "ice", "wall",
    "landmark",        "option"};
constexpr std::array<std::string_view, 3> value_names = {"not_a_number", "infinite", "absurd"};
constexpr std::array<std::string_view, 2> wheel_names = {"left", "right"};
constexpr std::array<std::string_view, 2> sensor_names = {"landmark_sensor", "encoders"};

constexpr double largest_outlier = 1e9;  // [sigma] a check against the noise refuses most before
constexpr double largest_jump = 36'000;  // [deg] one hundred turns

std::vector<Fields::Case> fault_cases(Fault& fault) {
  return {
      {"bad_observation", "the range of the first landmark that is seen is no measurement",
       [&](Fields& fields) {
         describe_choice(fields, "value", fault.value, value_names,
                         "what it is; absurd: a thousand kilometres");
       }},
      {"outlier", "the bearing of the first landmark that is seen is off",
       [&](Fields& fields) {
         fields.number("size_sigma", fault.size, between(-largest_outlier, largest_outlier),
                       "error in standard deviations, counter-clockwise", Need::required);
       }},
      {"encoder_jump", "the encoder of a wheel jumps, and goes on from there",
       [&](Fields& fields) {
         describe_choice(fields, "wheel", fault.wheel, wheel_names, "whose", Need::required);
         fields.angle("jump_deg", fault.jump, between(-largest_jump, largest_jump), "forwards",
                      Need::required);
       }},
      {"silence", "a sensor says nothing for a while",
       [&](Fields& fields) {
         describe_choice(fields, "sensor", fault.sensor, sensor_names, "which", Need::required);
         fields.number("duration_s", fault.duration, more_than_up_to(0, longest_duration), "for so long",
                       Need::required);
       }},
      {"kidnapping", "the robot is put somewhere else, and nothing tells it",
       [&](Fields& fields) { describe_placement(fields, fault.to, Need::required); }},
      {"ice", "a part of the ground gets another friction",
       [&](Fields& fields) { describe_patch(fields, fault.patch); }},
      {"wall", "a wall appears", [&](Fields& fields) { describe_wall(fields, fault.wall); }},
      {"landmark", "a landmark appears; it gets the next free id",
       [&](Fields& fields) { describe_landmark(fields, fault.landmark); }},
      {"option", "an option of an estimator changes, from the next measurement on",
       [&](Fields& fields) {
         fields.text("estimator", fault.estimator, "the name of the estimator", Need::required);
         fields.text("option", fault.option,
                     "its key; it is one that can change, or odometry_sd_factor or observation_sd_factor",
                     Need::required);
         fields.number("new_value", fault.option_value, any_number(), "the value that it gets",
                       Need::required);
       }},
  };
}

}  // namespace

void describe_fault(Fields& fields, Fault& fault) {
  std::string kind;
  fields.variant("kind", kind, fault_cases(fault), "what goes wrong", Need::required);
  fault.kind = enum_of<FaultKind>(kind_names, kind);
  fields.number("at_s", fault.at, between(0, longest_duration),
                "when: it comes with the first measurement, or the first step of the physics, from then on",
                Need::required);
  fields.text("robot", fault.robot, "in a team: the robot to which it happens; by default to every one",
              Need::optional);
}

}  // namespace worlds
