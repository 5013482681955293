#include "harness/estimators/registry.hpp"

#include <fmt/format.h>

#include <vector>

#include "harness/estimators/batch.hpp"
#include "harness/estimators/mrpt_ekf.hpp"
#include "worlds/suggestion.hpp"

namespace harness {

seif::Registry known_estimators() {
  seif::Registry registry = seif::standard_estimators();
  registry.add(batch_estimator(registry));
  registry.add(mrpt_ekf_estimator());
  // Add an estimator of your own here: registry.add(...) makes it known to world files and to all commands.
  return registry;
}

BadInput no_such_estimator(const seif::Registry& registry, std::string_view option, const std::string& name) {
  std::vector<std::string> names;
  for (const seif::EstimatorType& type : registry.types()) names.push_back(type.name);
  return BadInput(
      fmt::format("{}: there is no estimator '{}'{}", option, name, worlds::suggestion(name, names)));
}

}  // namespace harness
