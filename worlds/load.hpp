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

/// Describes the options of a type of estimator. It leaves a value for every option in the map.
using DescribeOptions = std::function<void(Fields&, std::map<std::string, OptionValue>&)>;

/// The types of estimators by name.
using EstimatorTypes = std::map<std::string, DescribeOptions>;

/// The types of estimators that a world file may use.
struct EstimatorSchemas {
  EstimatorTypes types;
  /// The types of a shared library that a world file names. Throws a std::exception that says why it cannot be
  /// loaded. Empty: files cannot name libraries.
  std::function<EstimatorTypes(const std::string& library)> of_library = {};
};

/// A check of a caller, for what this room does not know. It is called with the document and a world whose
/// parts are good, and adds what is wrong to the problems.
using FurtherCheck = std::function<void(const Node&, const World&, std::vector<Problem>&)>;

struct LoadResult {
  std::optional<World> world;  // nothing if there is a problem
  std::string
      resolved;  // YAML: everything merged, defaults explicit, generators unchanged; loads to the same world
  std::vector<Problem> problems;  // sorted by place
};

/// Loads a world: `name` is a file, or the bare name of a world of the gallery (find_world). `overrides` have the
/// form `path.to.key=value`; later ones replace earlier ones. A `version` that is not empty becomes the resolved
/// document's `seifbed_version`. The content of a file never makes this function throw, unless `check` throws.
LoadResult load_world(const std::filesystem::path& name, const std::vector<std::string>& overrides,
                      const EstimatorSchemas& estimators, std::string_view version = "",
                      const FurtherCheck& check = {});

/// Replaces each path of an estimator's library by the full path: those in a document are relative to the file
/// that they stand in, and those in an override to `file`.
void find_libraries(const std::filesystem::path& file, Node& document);

}  // namespace worlds
