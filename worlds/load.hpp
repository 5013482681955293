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

/// A check of a caller, for what this room does not know. It is called with the document and a world whose
/// parts are good, and adds what is wrong to the problems.
using FurtherCheck = std::function<void(const Node&, const World&, std::vector<Problem>&)>;

struct LoadResult {
  std::optional<World> world;  // nothing if there is a problem
  std::string
      resolved;  // YAML: everything merged, defaults explicit, generators unchanged; loads to the same world
  std::vector<Problem> problems;  // sorted by place
};

/// Loads a world file. `overrides` have the form `path.to.key=value`; later ones replace earlier ones. A
/// `version` that is not empty becomes the resolved document's `seifbed_version`. The content of a file never
/// makes this function throw, unless `check` throws.
LoadResult load_world(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                      const EstimatorSchemas& estimators, std::string_view version = "",
                      const FurtherCheck& check = {});

}  // namespace worlds
