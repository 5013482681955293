#include "harness/comparison/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

bool is_among(std::span<const worlds::EstimatorChoice> estimators, const std::string& name) {
  return std::ranges::find(estimators, name, &worlds::EstimatorChoice::name) != estimators.end();
}

}  // namespace

std::string choose_baseline(const std::string& asked, std::span<const worlds::EstimatorChoice> estimators) {
  if (estimators.empty()) throw BadInput("there are no estimators to compare");
  if (asked.empty()) return is_among(estimators, "ekf") ? "ekf" : estimators.front().name;
  if (!is_among(estimators, asked))
    throw BadInput(fmt::format("--baseline: there is no estimator '{}'", asked));
  return asked;
}

worlds::LoadResult load_with_baseline(const std::string& baseline, const seif::Registry& registry,
                                      std::vector<std::string>& overrides,
                                      const std::function<worlds::LoadResult()>& load) {
  worlds::LoadResult loaded = load();
  if (!loaded.world || is_among(loaded.world->estimators, baseline) || registry.find(baseline) == nullptr)
    return loaded;
  overrides.push_back(fmt::format("estimators.{}={{}}", baseline));
  return load();
}

}  // namespace harness
