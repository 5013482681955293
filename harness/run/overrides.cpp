#include "harness/run/overrides.hpp"

#include <fmt/format.h>

#include "harness/files/bad_input.hpp"

namespace harness {

void add_override(std::vector<std::string>& overrides, const std::string& option, const std::string& key,
                  const std::string& value) {
  for (const std::string& assignment : overrides) {
    if (assignment.starts_with(key + '='))
      throw BadInput(
          fmt::format("--set {}: {} {} gives this too; leave one of them out", assignment, option, value));
  }
  overrides.push_back(key + '=' + value);
}

}  // namespace harness
