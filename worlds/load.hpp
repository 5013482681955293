// Reads and checks a world file completely before anything runs.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/document.hpp"
#include "worlds/fields.hpp"
#include "worlds/world.hpp"

namespace worlds {

/// For each type of estimator, the function that describes its options. It leaves a value for every option in
/// the map.
using EstimatorSchemas =
    std::map<std::string, std::function<void(Fields&, std::map<std::string, OptionValue>&)>>;

struct LoadResult {
  std::optional<World> world;  // nothing if there is a problem
  std::string
      resolved;  // YAML: everything merged, defaults explicit, generators unchanged; loads to the same world
  std::vector<Problem> problems;  // sorted by place
};

/// Loads a world file. `overrides` have the form `path.to.key=value`; later ones replace earlier ones. A
/// `version` that is not empty becomes the resolved document's `seifbed_version`. The content of a file never
/// makes this function throw.
LoadResult load_world(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                      const EstimatorSchemas& estimators, std::string_view version = "");

}  // namespace worlds
