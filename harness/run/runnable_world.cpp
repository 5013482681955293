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

/// As prepare_run will: one by one, so that each mistake has its place, and then together.
void check_estimators(const worlds::Node& document, const worlds::World& world,
                      const seif::Registry& registry, Problems& problems) {
  const LogDescription log = description_without_truth(world);
  const std::size_t before = problems.size();
  for (const worlds::EstimatorChoice& choice : world.estimators) {
    refuse_if_thrown(document, "estimators." + choice.name, problems, [&] {
      make_estimators(registry, able_estimators(registry, std::span(&choice, 1), log).choices, log,
                      world.seed);
    });
  }
  if (problems.size() > before || world.estimators.empty()) return;
  AbleEstimators able;
  refuse_if_thrown(document, "estimators." + world.estimators.front().name, problems,
                   [&] { able = some_able_estimators(registry, world, log); });
  if (problems.size() > before) return;
  refuse_if_thrown(document, "drive.pose_from", problems, [&] { check_steering(world, able); });
}

/// Each change, after those before it.
void check_option_changes(const worlds::Node& document, const worlds::World& world,
                          const seif::Registry& registry, Problems& problems) {
  std::vector<worlds::EstimatorChoice> choices = world.estimators;
  for (const OptionChange& change : option_changes(world)) {
    const auto fault = std::ranges::find_if(world.faults, [&](const worlds::Fault& f) {
      return f.kind == worlds::FaultKind::option && f.at == change.at && f.option == change.option &&
             f.estimator == change.estimator;
    });
    const std::string path = fmt::format("faults.{}", fault - world.faults.begin());
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
        check_estimators(document, world, registry, problems);
        if (problems.empty()) check_option_changes(document, world, registry, problems);
      });
}

}  // namespace harness
