#include "harness/run/runnable_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/run/option_changes.hpp"
#include "harness/run/without_names.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "worlds/check.hpp"

namespace harness {

namespace {

using Problems = std::vector<worlds::Problem>;

template <class Check>
void refuse_if_thrown(const worlds::Node& document, const std::string& path, Problems& problems,
                      const Check& check) {
  try {
    check();
  } catch (const std::exception& error) {
    worlds::refuse_value(document, path, error.what(), problems);
  }
}

/// A robot of the world, and where the document has what is its own.
struct RobotToCheck {
  worlds::World world;
  std::string drive;       // path
  std::string estimators;  // path
};

std::vector<RobotToCheck> robots_of(const worlds::World& world) {
  if (world.robots.empty()) return {{world, "drive", "estimators"}};
  std::vector<RobotToCheck> robots;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const std::string robot = fmt::format("robots.{}.", i);
    const bool has_estimators = !world.robots[i].estimators.empty();
    robots.push_back({worlds::world_of_robot(world, i), robot + "drive",
                      has_estimators ? robot + "estimators" : "estimators"});
  }
  return robots;
}

/// As prepare_run will: one by one, so that each mistake has its place, and then together.
void check_estimators(const worlds::Node& document, const RobotToCheck& robot, const seif::Registry& registry,
                      Problems& problems) {
  const worlds::World& world = robot.world;
  const LogDescription log = description_without_truth(world);
  const std::size_t before = problems.size();
  for (const worlds::EstimatorChoice& choice : world.estimators) {
    refuse_if_thrown(document, fmt::format("{}.{}", robot.estimators, choice.name), problems, [&] {
      make_estimators(registry, able_estimators(registry, std::span(&choice, 1), log).choices, log,
                      world.seed);
    });
  }
  if (problems.size() > before || world.estimators.empty()) return;
  AbleEstimators able;
  refuse_if_thrown(document, fmt::format("{}.{}", robot.estimators, world.estimators.front().name), problems,
                   [&] { able = some_able_estimators(registry, world, log); });
  if (problems.size() > before) return;
  refuse_if_thrown(document, robot.drive + ".pose_from", problems, [&] { check_steering(world, able); });
}

/// Where the world has the fault that this change comes from.
std::string place_of(const worlds::World& world, const OptionChange& change) {
  const auto fault = std::ranges::find_if(world.faults, [&](const worlds::Fault& f) {
    return f.kind == worlds::FaultKind::option && f.at == change.at && f.option == change.option &&
           f.estimator == change.estimator;
  });
  return fmt::format("faults.{}", fault - world.faults.begin());
}

/// Each change, after those before it. `whole`: the world of all robots.
void check_option_changes(const worlds::Node& document, const worlds::World& whole,
                          const worlds::World& world, const seif::Registry& registry, Problems& problems) {
  std::vector<worlds::EstimatorChoice> choices = world.estimators;
  for (const OptionChange& change : option_changes(world)) {
    const std::string path = place_of(whole, change);
    const auto choice = std::ranges::find(choices, change.estimator, &worlds::EstimatorChoice::name);
    if (choice == choices.end()) {
      worlds::refuse_value(document, path + ".estimator",
                           fmt::format("there is no estimator '{}' in this world", change.estimator),
                           problems);
    } else if (const auto why = fault_of_change(registry, *choice, change)) {
      worlds::refuse_value(document, path + ".new_value", *why, problems);
    } else {
      apply(change, *choice);
    }
  }
}

}  // namespace

worlds::LoadResult load_runnable_world(const std::filesystem::path& file,
                                       const std::vector<std::string>& overrides,
                                       const seif::Registry& registry, std::string_view version) {
  return worlds::load_world(
      file, overrides, estimator_schemas(registry), version,
      [&](const worlds::Node& document, const worlds::World& world, std::vector<worlds::Problem>& problems) {
        const std::vector<RobotToCheck> robots = robots_of(world);
        for (const RobotToCheck& robot : robots) check_estimators(document, robot, registry, problems);
        if (!problems.empty()) return;
        for (const RobotToCheck& robot : robots)
          check_option_changes(document, world, robot.world, registry, problems);
      });
}

}  // namespace harness
