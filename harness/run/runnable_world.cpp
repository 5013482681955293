#include "harness/run/runnable_world.hpp"

#include <exception>
#include <span>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/simulation/simulated_stream.hpp"
#include "worlds/check.hpp"

namespace harness {

namespace {

void check_estimators(const worlds::Node& document, const worlds::World& world,
                      const seif::Registry& registry, std::vector<worlds::Problem>& problems) {
  const LogDescription log = description_without_truth(world);
  for (const worlds::EstimatorChoice& choice : world.estimators) {
    try {
      make_estimators(registry, std::span(&choice, 1), log, world.seed);
    } catch (const std::exception& error) {
      worlds::refuse_value(document, "estimators." + choice.name, error.what(), problems);
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
      });
}

}  // namespace harness
