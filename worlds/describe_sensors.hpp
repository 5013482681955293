// The descriptions of the robot's sensors, and of the uncertainty of its start.
#pragma once

#include "worlds/fields.hpp"
#include "worlds/sensors.hpp"

namespace worlds {

void describe_encoders(Fields& fields, Encoders& encoders);
void describe_landmark_sensor(Fields& fields, LandmarkSensor& sensor);
/// Both sensors.
void describe_sensors(Fields& fields, Encoders& encoders, LandmarkSensor& landmark_sensor);
void describe_start_estimate(Fields& fields, StartEstimate& start);

}  // namespace worlds
