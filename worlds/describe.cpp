#include "worlds/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "worlds/describe_drive.hpp"
#include "worlds/describe_estimators.hpp"
#include "worlds/describe_fault.hpp"
#include "worlds/describe_parts.hpp"
#include "worlds/describe_sensors.hpp"
#include "worlds/describe_team.hpp"
#include "worlds/film_layers.hpp"
#include "worlds/suggestion.hpp"

namespace worlds {
namespace {

// Limits that stop a typing mistake from asking for more than a machine has.
constexpr double largest_height = 1e3;             // [m]
constexpr double highest_turn_rate = 1e4;          // [deg/s]
constexpr double highest_acceleration = 1e4;       // [m/s^2]
constexpr double highest_turn_acceleration = 1e6;  // [deg/s^2]
constexpr double largest_torque = 1e5;             // [N m]
constexpr double highest_density = 1e6;            // [1/m^2]
constexpr double shortest_interval = 1e-6;         // [s]
constexpr double largest_sample = 1e6;             // [-]
constexpr double slowest_film = 1e-3;              // [-] a slower one would not end
constexpr double fastest_film = 1e6;               // [-]
constexpr std::size_t longest_world_name = 200;    // [byte]
constexpr std::size_t longest_list =
    1000;  // [-] of generators, patches or faults: each looks at the whole world
constexpr double smallest_landmark_radius = 1e-3;  // [m] of a landmark
constexpr double largest_landmark_radius = 100;    // [m] of a landmark
constexpr double most_landmarks = 1e7;             // [-] of one generator
constexpr double most_clusters = 1e5;              // [-]
constexpr double most_tries = 1e6;                 // [-]
constexpr double smallest_film = 64;               // [px]
constexpr double largest_film = 7680;              // [px]
constexpr double highest_film_rate = 240;          // [1/s]
constexpr std::size_t most_filmed = 2;             // [-] estimators side by side

constexpr std::array<std::string_view, 2> engine_names = {"bullet", "kinematic"};
constexpr std::array<std::string_view, 6> pattern_names = {"uniform", "poisson_disk", "grid",
                                                           "ring",    "clusters",     "corridor"};
constexpr std::array<std::string_view, 5> camera_names = {"overview", "chase", "orbit", "top", "fixed"};

}  // namespace

void describe_landmark(Fields& fields, Landmark& landmark) {
  fields.number("x_m", landmark.position.x(), coordinate(), "east", Need::required);
  fields.number("y_m", landmark.position.y(), coordinate(), "north", Need::required);
  fields.number("radius_m", landmark.radius, between(smallest_landmark_radius, largest_landmark_radius),
                "radius");
}

void describe_patch(Fields& fields, FrictionPatch& patch) {
  fields.vector2("min_m", patch.min, coordinate(), "lower left corner", Need::required);
  fields.vector2("max_m", patch.max, coordinate(), "upper right corner", Need::required);
  fields.number("friction", patch.friction, between(0, 10), "friction coefficient between wheels and ground");
  check_corners(fields, patch.min, patch.max);
}

void describe_wall(Fields& fields, Wall& wall) {
  fields.points("points_m", wall.points, coordinate(), 2, "corners", Need::required);
  fields.number("thickness_m", wall.thickness, more_than_up_to(0, largest_ground), "thickness");
  fields.number("height_m", wall.height, more_than_up_to(0, largest_height), "height");
  fields.boolean("closed", wall.closed, "whether it also runs from the last point back to the first");
  const std::size_t expected = wall.points.size() - (wall.closed ? 0 : 1);
  if (fields.sound() && !wall.points.empty() && legs(wall.points, wall.closed).size() != expected) {
    fields.problem("points_m", wall.closed
                                   ? "two corners in a row are equal (a closed wall returns by itself)"
                                   : "two corners in a row are equal");
  }
}

namespace {

void check_robot(Fields& fields, const Robot& robot) {
  if (!fields.sound()) return;
  if (2 * robot.wheel_mass >= robot.mass) {
    fields.problem("wheel_mass_kg", "the wheels must weigh less than the robot of which they are a part");
  }
  if (robot.track <= 2 * robot.wheel_radius) {
    fields.problem("track_m", "the track must be more than two wheel radii, or the wheels would touch");
  }
  if (robot.caster.radius > robot.wheel_radius) {
    fields.problem("caster", "the caster's radius must be at most that of the wheels, or it does not fit");
  }
  if (std::abs(robot.caster.offset) < robot.caster.radius) {
    fields.problem("caster",
                   "the caster must be its radius or more away from the axle, or the robot topples");
  }
}

void check_length(Fields& fields, std::string_view key, std::size_t count, std::size_t most = longest_list) {
  if (count > most)
    fields.problem(key, fmt::format("'{}' must have at most {} items, not {}", key, most, count));
}

void describe_robot(Fields& fields, Robot& robot) {
  fields.section("start", "where the middle of the axle is at the start",
                 [&](Fields& inner) { describe_placement(inner, robot.start, Need::defaulted); });
  fields.number("mass_kg", robot.mass, more_than_up_to(0, 1000), "mass of the whole robot");
  fields.number("wheel_mass_kg", robot.wheel_mass, between(0.1, 1000), "mass of one wheel");
  fields.number("wheel_radius_m", robot.wheel_radius, between(0.02, 1), "radius of the wheels");
  fields.number("track_m", robot.track, between(0.05, 5), "distance between the wheels' contact points");
  fields.number("motor_torque_nm", robot.motor_torque, more_than_up_to(0, largest_torque),
                "the most that one wheel's motor gives");
  fields.number("max_speed_m_s", robot.max_speed, more_than_up_to(0, highest_speed), "highest speed");
  fields.angle("max_turn_rate_deg_s", robot.max_turn_rate, more_than_up_to(0, highest_turn_rate),
               "highest turn rate");
  fields.number("max_acceleration_m_s2", robot.max_acceleration, more_than_up_to(0, highest_acceleration),
                "highest acceleration");
  fields.angle("max_turn_acceleration_deg_s2", robot.max_turn_acceleration,
               more_than_up_to(0, highest_turn_acceleration), "highest acceleration of the turn rate");
  fields.section("caster", "the frictionless third support", [&](Fields& inner) {
    inner.number("offset_m", robot.caster.offset, between(-5, 5), "forward of the axle; negative is behind");
    inner.number("radius_m", robot.caster.radius, between(0.001, 1), "radius");
  });
  check_robot(fields, robot);
}

void describe_physics(Fields& fields, Physics& physics) {
  describe_choice(fields, "engine", physics.engine, engine_names,
                  "bullet: rigid bodies that touch and hide each other; kinematic, for many fast runs: exact "
                  "arcs, no slip, landmarks that are points, no obstacles or patches");
  fields.integer("step_rate_hz", physics.step_rate, between(50, highest_step_rate), "physics steps");
  fields.number("friction", physics.friction, between(0, 10),
                "friction coefficient between wheels and ground");
  fields.list("patches", physics.patches, describe_patch,
              "rectangles of the ground with a friction of their own; the later one counts");
  check_length(fields, "patches", physics.patches.size());
}

void describe_region(Fields& fields, Generator& generator, const Eigen::Vector2d& ground_size) {
  generator.min = -0.5 * ground_size;
  generator.max = 0.5 * ground_size;
  fields.section("region", "where the landmarks stand; by default the whole ground", [&](Fields& inner) {
    inner.vector2("min_m", generator.min, coordinate(), "lower left corner", Need::optional);
    inner.vector2("max_m", generator.max, coordinate(), "upper right corner", Need::optional);
    check_corners(inner, generator.min, generator.max);
    const Eigen::Array2d edge = 0.5 * ground_size.array();
    if (inner.sound() && ((generator.min.array() < -edge).any() || (generator.max.array() > edge).any())) {
      inner.problem("", "the region must lie on the ground");
    }
  });
}

void describe_count(Fields& fields, Generator& generator) {
  fields.integer("count", generator.count, between(1, most_landmarks), "landmarks to place", Need::optional);
  fields.number("density_per_m2", generator.density, more_than_up_to(0, highest_density),
                "landmarks to place, for each square metre", Need::optional);
  if (fields.sound() && (generator.count > 0) == (generator.density > 0)) {
    fields.problem(generator.count > 0 ? "density_per_m2" : "",
                   "exactly one of 'count' and 'density_per_m2' must be given");
  }
}

void describe_fixed_places(Fields& fields, Generator& generator) {
  fields.number("jitter_m", generator.jitter, between(0, largest_clearance),
                "random shift of each place, at most, in x and in y");
  fields.boolean("skip_blocked", generator.skip_blocked, "leave out places that are not free");
}

void describe_corridor(Fields& fields, Generator& generator) {
  fields.points("points_m", generator.points, coordinate(), 2, "the line; by default the path of the drive",
                Need::optional);
  fields.boolean("closed", generator.closed, "whether it also runs from the last point back to the first");
  fields.number("offset_m", generator.offset, more_than_up_to(0, largest_ground),
                "distance from the line to the landmarks on either side");
  fields.number("spacing_m", generator.spacing, more_than_up_to(0, largest_ground),
                "distance between landmarks along the line");
  describe_fixed_places(fields, generator);
}

std::vector<Fields::Case> generator_cases(Generator& generator, const Eigen::Vector2d& ground_size) {
  const auto region_and_count = [&generator, ground_size](Fields& fields) {
    describe_region(fields, generator, ground_size);
    describe_count(fields, generator);
  };
  return {
      {"uniform", "anywhere in the region", region_and_count},
      {"poisson_disk", "anywhere in the region, but not close to each other",
       [&, region_and_count](Fields& fields) {
         fields.number("distance_m", generator.distance, more_than_up_to(0, largest_ground),
                       "at least, between centres");
         region_and_count(fields);
       }},
      {"grid", "in the middle of each cell of a grid",
       [&, ground_size](Fields& fields) {
         fields.vector2("cell_m", generator.cell, more_than_up_to(0, largest_ground), "size of a cell",
                        Need::required);
         describe_region(fields, generator, ground_size);
         describe_fixed_places(fields, generator);
       }},
      {"ring", "evenly around a circle",
       [&](Fields& fields) {
         fields.vector2("centre_m", generator.centre, coordinate(), "centre of the circle");
         fields.number("ring_radius_m", generator.ring_radius, more_than_up_to(0, largest_ground),
                       "radius of the circle");
         fields.integer("count", generator.count, between(1, most_landmarks), "landmarks to place",
                        Need::required);
         describe_fixed_places(fields, generator);
       }},
      {"clusters", "around points anywhere in the region",
       [&, region_and_count](Fields& fields) {
         fields.integer("clusters", generator.clusters, between(1, most_clusters), "how many clusters");
         fields.number("cluster_sd_m", generator.cluster_sd, more_than_up_to(0, largest_ground),
                       "standard deviation of a cluster");
         region_and_count(fields);
       }},
      {"corridor", "on both sides along a line",
       [&](Fields& fields) { describe_corridor(fields, generator); }},
  };
}

void describe_generator(Fields& fields, Generator& generator, const Eigen::Vector2d& ground_size) {
  std::string pattern;
  fields.variant("type", pattern, generator_cases(generator, ground_size), "pattern", Need::required);
  generator.pattern = enum_of<Pattern>(pattern_names, pattern);
  fields.number("radius_m", generator.radius, between(smallest_landmark_radius, largest_landmark_radius),
                "radius of each landmark");
  fields.integer("max_tries", generator.max_tries, between(1, most_tries), "tries to place each landmark");
  fields.section("clear_m", "how far the surface of a landmark stays from other things", [&](Fields& inner) {
    inner.number("walls", generator.clear.walls, between(0, largest_clearance),
                 "least distance from the surfaces of walls and boxes");
    inner.number("path", generator.clear.path, between(0, largest_clearance),
                 "least distance from the path that the robot is meant to drive");
    inner.number("landmarks", generator.clear.landmarks, between(0, largest_clearance),
                 "least distance from the surfaces of other landmarks");
  });
}

void describe_box(Fields& fields, Box& box) {
  describe_placement(fields, box.centre, Need::required);
  fields.vector2("size_m", box.size, more_than_up_to(0, largest_ground), "size along its own x and y",
                 Need::required);
  fields.number("height_m", box.height, more_than_up_to(0, largest_height), "height");
}

void describe_scoring(Fields& fields, Scoring& scoring) {
  fields.number("interval_s", scoring.interval, between(shortest_interval, longest_duration),
                "time between two scorings of consistency");
  fields.integer("landmark_sample", scoring.landmark_sample, between(1, largest_sample),
                 "landmarks that are scored for consistency, at the most");
  fields.number("rpe_interval_s", scoring.rpe_interval, between(shortest_interval, longest_duration),
                "time over which the relative pose error is taken");
}

void describe_camera(Fields& fields, Film& film) {
  describe_choice(
      fields, "camera", film.camera, camera_names,
      "overview: the whole ground; chase: behind the robot; orbit: round the robot; top: straight "
      "down on the robot; fixed: from eye_m to target_m");
  fields.vector3("eye_m", film.eye, coordinate(), "where the fixed camera is");
  fields.vector3("target_m", film.target, coordinate(), "what the fixed camera looks at");
  if (fields.sound() && film.camera == FilmCamera::fixed && film.eye == film.target) {
    fields.problem("eye_m", "'eye_m' must differ from 'target_m', or the camera looks nowhere");
  }
}

void describe_film(Fields& fields, Film& film) {
  Eigen::Vector2d size(film.width, film.height);
  fields.vector2("size_px", size, even_between(smallest_film, largest_film), "width and height");
  film.width = static_cast<int>(size.x());
  film.height = static_cast<int>(size.y());
  fields.integer("fps", film.fps, between(1, highest_film_rate), "frames for each second of the film");
  fields.number("speed", film.speed, between(0, fastest_film),
                "simulated over film time; 0: so that the film takes 40 s at the most");
  if (fields.sound() && film.speed > 0 && film.speed < slowest_film)
    fields.problem("speed", fmt::format("'speed' must be 0 or at least {}", slowest_film));
  describe_camera(fields, film);
  fields.names("estimators", film.estimators, most_filmed,
               "one or two names; none: seif and ekf if they run, or the first two");
  fields.section("layers", "what is shown", [&](Fields& inner) {
    for (const auto& [name, shown, help] : film_layers) inner.boolean(name, film.layers.*shown, help);
  });
}

}  // namespace

void describe_world(Fields& fields, WorldFile& file, const EstimatorSchemas& estimators) {
  World& world = file.world;
  fields.text("name", world.name, "name of the world; by default the file's name");
  if (fields.sound() && world.name.find_first_of("\n\t") != std::string::npos)
    fields.problem("name", "'name' must be one line without tabs");
  if (fields.sound() && world.name.size() > longest_world_name)
    fields.problem("name", fmt::format("'name' must have at most {} bytes", longest_world_name));
  fields.text("description", world.description, "one sentence on what the world shows");
  fields.text("seifbed_version", file.version, "the program that resolved this file", Need::optional);
  fields.integer("seed", world.seed, between(0, beyond_integers), "seed of all random numbers");
  fields.number("duration_s", world.duration, more_than_up_to(0, longest_duration), "length of the run");
  fields.section("ground", "the ground, centred on the origin", [&](Fields& inner) {
    inner.vector2("size_m", world.ground_size, between(1, largest_ground), "size along x and y");
  });
  fields.section("robot", "the robot", [&](Fields& inner) { describe_robot(inner, world.robot); });
  fields.section("physics", "the physics", [&](Fields& inner) { describe_physics(inner, world.physics); });
  fields.section("landmarks", "what the sensor sees", [&](Fields& inner) {
    inner.list("placed", world.landmarks, describe_landmark, "landmarks placed by hand; they come first");
    inner.list(
        "generators", file.generators,
        [&](Fields& item, Generator& generator) { describe_generator(item, generator, world.ground_size); },
        "landmarks placed by a rule, in this order");
    check_length(inner, "generators", file.generators.size());
  });
  fields.section("obstacles", "what blocks motion and sight", [&](Fields& inner) {
    inner.list("boxes", world.boxes, describe_box, "boxes");
    inner.list("walls", world.walls, describe_wall, "walls along polylines");
  });
  fields.section("drive", "what the robot is told to do",
                 [&](Fields& inner) { describe_drive(inner, world.drive, file.area); });
  fields.section("sensors", "what the robot measures with",
                 [&](Fields& inner) { describe_sensors(inner, world.encoders, world.landmark_sensor); });
  fields.list("faults", world.faults, describe_fault, "faults injected on purpose, each at its time");
  check_length(fields, "faults", world.faults.size());
  fields.section("start_estimate", "standard deviations of the start that the estimators are given",
                 [&](Fields& inner) { describe_start_estimate(inner, world.start_estimate); });
  describe_estimators(fields, world.estimators, estimators, "the estimators that run, by names of your own");
  describe_team(fields, file, estimators);
  check_length(fields, "robots", file.robots.size(), most_robots_of_team);
  fields.section("scoring", "how the run is scored",
                 [&](Fields& inner) { describe_scoring(inner, world.scoring); });
  fields.section("film", "how the run is filmed", [&](Fields& inner) { describe_film(inner, world.film); });
}

}  // namespace worlds
