#include "seif/registry.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace seif {

void Registry::add(EstimatorType type) {
  if (find(type.name) != nullptr)
    throw std::invalid_argument("estimator '" + type.name + "' is registered already");
  types_.push_back(std::move(type));
}

const EstimatorType* Registry::find(std::string_view name) const {
  const auto it = std::ranges::find(types_, name, &EstimatorType::name);
  return it == types_.end() ? nullptr : &*it;
}

}  // namespace seif
