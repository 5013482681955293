#include "harness/estimators/registry.hpp"

#include "harness/estimators/batch.hpp"
#include "harness/estimators/mrpt_ekf.hpp"

namespace harness {

seif::Registry known_estimators() {
  seif::Registry registry = seif::standard_estimators();
  registry.add(batch_estimator(registry));
  registry.add(mrpt_ekf_estimator());
  // Add an estimator of your own here: registry.add(...) makes it known to world files and to all commands.
  return registry;
}

}  // namespace harness
