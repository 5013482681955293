// Options of the command line that stand for a value of the world file.
#pragma once

#include <string>
#include <vector>

namespace harness {

/// Adds the override `key=value` of an option such as --seed. Throws BadInput if a --set gives the same key.
void add_override(std::vector<std::string>& overrides, const std::string& option, const std::string& key,
                  const std::string& value);

}  // namespace harness
