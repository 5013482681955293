// World files, read and checked completely before anything runs.
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

/// For each type of estimator, what describes its options. A description leaves a value for every option in
/// the map.
using EstimatorSchemas =
    std::map<std::string, std::function<void(Fields&, std::map<std::string, OptionValue>&)>>;

struct LoadResult {
  std::optional<World> world;  // nothing if there is a problem
  std::string
      resolved;  // YAML: all merged, defaults explicit, generators as they are; loads to the same world
  std::vector<Problem> problems;  // sorted by place
};

/// Loads a world file. `overrides` are `path.to.key=value`, later ones win. `version`, if any, becomes the
/// resolved document's `seifbed_version`. Does not throw for anything that stands in a file.
LoadResult load_world(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                      const EstimatorSchemas& estimators, std::string_view version = "");

}  // namespace worlds
