// A world: one scenario, complete and checked, as plain values. SI units and radians.
// World frame: x east, y north; the ground is centred on the origin. Yaw counter-clockwise.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "worlds/fault.hpp"

namespace worlds {

inline constexpr double degree = std::numbers::pi / 180;  // [rad]

struct Caster {
  double offset = -0.18;  // [m] along the robot's x from the axle; negative is behind
  double radius = 0.04;   // [m]
};

/// A differential-drive robot: chassis, two driven wheels, a frictionless caster.
struct Robot {
  Placement start;
  double mass = 8.0;                            // [kg] of the whole robot
  double wheel_mass = 0.3;                      // [kg] of one wheel, part of `mass`
  double wheel_radius = 0.1;                    // [m]
  double track = 0.4;                           // [m] between the wheels' contact points
  double motor_torque = 2.0;                    // [N m] the most that one wheel's motor gives
  double max_speed = 1.0;                       // [m/s]
  double max_turn_rate = 90 * degree;           // [rad/s]
  double max_acceleration = 1.0;                // [m/s^2]
  double max_turn_acceleration = 240 * degree;  // [rad/s^2]
  Caster caster;
};

/// An axis-aligned rectangle of the ground with a friction of its own.
struct FrictionPatch {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d max = Eigen::Vector2d::Zero();  // [m]
  double friction = 0.1;                          // [-]
};

enum class Engine {
  bullet,     // rigid bodies: contacts, friction and slip; landmarks and obstacles block motion and sight
  kinematic,  // exact arcs without slip; landmarks are points that block nothing; no obstacles, no patches
};

struct Physics {
  Engine engine = Engine::bullet;
  int step_rate = 240;                 // [Hz]
  double friction = 0.9;               // [-] Coulomb coefficient between wheels and ground
  std::vector<FrictionPatch> patches;  // where they overlap the later one counts
};

/// A vertical cylinder that the sensor can see and the robot can bump into.
struct Landmark {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // p_world [m], of the axis
  double radius = 0.1;                                 // [m]
};

/// A box on the ground that blocks motion and sight.
struct Box {
  Placement centre;
  Eigen::Vector2d size = Eigen::Vector2d::Ones();  // [m] along its own x and y
  double height = 1.0;                             // [m]
};

/// A wall along a polyline that blocks motion and sight.
struct Wall {
  std::vector<Eigen::Vector2d> points;  // [m], at least two
  double thickness = 0.15;              // [m]
  double height = 1.0;                  // [m]
  bool closed = false;                  // from the last point back to the first
};

enum class DriveMode { hold, waypoints, loop, serpentine, explore, commands };

/// A velocity command that holds from its time until the next one's.
struct VelocityCommand {
  double t = 0.0;      // [s]
  double v = 0.0;      // [m/s]
  double omega = 0.0;  // [rad/s]
};

/// What the robot is told to do.
struct Drive {
  DriveMode mode = DriveMode::hold;
  std::string pose_from = "truth";        // whose pose steers: truth, odometry, or an estimator's name
  double speed = 0.6;                     // [m/s] cruising
  double lookahead = 0.6;                 // [m] of the pure pursuit
  std::vector<Eigen::Vector2d> path;      // waypoints, loop and serpentine: the polyline to follow [m]
  bool closed = false;                    // the path is driven round and round
  double clearance = 0.5;                 // [m] explore: from the robot's centre to anything solid
  std::vector<VelocityCommand> commands;  // commands: in the order of time
  std::string commands_file;              // commands: where they were read from, resolved
};

/// Wheel encoders. The filters believe the nominal radius and track; the systematic errors are what they do
/// not know.
struct Encoders {
  int rate = 20;                    // [Hz] of odometry
  int ticks_per_revolution = 4096;  // [-] 0: no quantisation
  double distance_sd = 0.005;       // [m/sqrt(m)] random error of one wheel after 1 m rolled
  double diameter_ratio = 1.0;  // [-] Borenstein's E_d: right over left wheel diameter, actual over assumed
  double track_ratio = 1.0;     // [-] Borenstein's E_b: actual over assumed track
  double diameter_ratio_sd = 0.0;  // [-] of the part of E_d that is drawn from the seed
  double track_ratio_sd = 0.0;     // [-] of the part of E_b that is drawn from the seed
  bool calibrated = false;         // no systematic error, whatever the four values above say
};

enum class LandmarkIds { known, hidden };

/// A range-bearing sensor that knows which landmark it sees, unless it is told not to.
struct LandmarkSensor {
  int rate = 5;                      // [Hz] of scans
  Placement mount;                   // T_robot_sensor
  double max_range = 8.0;            // [m]
  double fov = 360 * degree;         // [rad] full angle, centred on the sensor's x
  double range_sd = 0.05;            // [m]
  double range_sd_per_m = 0.0;       // [-] grows with range, added in quadrature
  double bearing_sd = 0.5 * degree;  // [rad]
  double miss_probability = 0.0;     // [-] that a visible landmark is not reported
  double false_detections = 0.0;     // [-] mean number in a scan (Poisson), with ids that no landmark has
  double misread_probability = 0.0;  // [-] that an observation bears another landmark's id
  LandmarkIds ids = LandmarkIds::known;
};

/// The start estimate is drawn from N(truth, P0), P0 diagonal.
struct StartEstimate {
  double x_sd = 0.05;                // [m]
  double y_sd = 0.05;                // [m]
  double heading_sd = 0.5 * degree;  // [rad]
};

using OptionValue = std::variant<bool, std::int64_t, double, std::string>;

/// An estimator to run, under a name of its own. What its options mean, only the estimator knows.
struct EstimatorChoice {
  std::string name;
  std::string type;                 // the registered kind; by default the name
  double odometry_sd_factor = 1.0;  // [-] what it believes of the odometry noise, over what the sensor says
  double observation_sd_factor = 1.0;          // [-] the same for observations
  std::map<std::string, OptionValue> options;  // a value for every option of the type
};

struct Scoring {
  double interval = 10.0;     // [s] between the times at which consistency is scored
  int landmark_sample = 200;  // [-] landmarks scored for consistency, at the most
  double rpe_interval = 1.0;  // [s] over which the relative pose error is taken
};

enum class FilmCamera {
  overview,  // the whole ground, from a height
  chase,     // behind the robot
  orbit,     // round the robot
  top,       // straight down on the robot, north up
  fixed,     // from eye to target
};

/// What a film of a run shows.
struct FilmLayers {
  bool grid = true;        // on the ground
  bool shadows = true;     //
  bool rays = true;        // of the latest scan, free and occluded
  bool range = true;       // what the sensor covers
  bool truth = true;       // trail of the robot
  bool odometry = true;    // trail of dead reckoning
  bool estimate = true;    // trail and present pose of each estimator
  bool landmarks = true;   // estimates of landmarks
  bool ellipses = true;    // 2-sigma ellipses of landmarks and robot
  bool errors = true;      // from each estimate to the truth
  bool active = true;      // landmarks that have a link to the robot
  bool links = true;       // between landmarks
  bool matrix = true;      // normalised information matrix, or covariance
  bool times = true;       // chart of update times
  bool pose_error = true;  // chart of pose errors with their 3-sigma bands
  bool caption = true;     //
  bool legend = true;      //
};

/// How a run is filmed.
struct Film {
  int width = 1280;    // [px] even
  int height = 720;    // [px] even
  int fps = 30;        // [1/s] of film time
  double speed = 0.0;  // [-] simulated over film time; 0: so that the film takes 40 s at the most
  FilmCamera camera = FilmCamera::overview;
  Eigen::Vector3d eye = {-15, -15, 12};  // [m] of the fixed camera
  Eigen::Vector3d target = {0, 0, 0};    // [m] of the fixed camera
  std::vector<std::string> estimators;   // one or two names; none: seif and ekf if they run, or the first two
  FilmLayers layers;
};

struct World {
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  double duration = 60.0;                                 // [s]
  Eigen::Vector2d ground_size = Eigen::Vector2d(40, 40);  // [m] centred on the origin
  Robot robot;
  Physics physics;
  std::vector<Landmark> landmarks;  // the index is the landmark's id
  std::vector<Box> boxes;
  std::vector<Wall> walls;
  Drive drive;
  Encoders encoders;
  LandmarkSensor landmark_sensor;
  std::vector<Fault> faults;
  StartEstimate start_estimate;
  std::vector<EstimatorChoice> estimators;  // in the order of the file
  Scoring scoring;
  Film film;
};

}  // namespace worlds
