#include "worlds/read_fault.hpp"

#include <fmt/format.h>

#include "worlds/check_faults.hpp"
#include "worlds/describe_fault.hpp"

namespace worlds {

std::optional<Fault> read_fault(std::string_view yaml, const World& world, std::vector<Problem>& problems) {
  std::optional<Node> document = parse_document(fmt::format("faults: [{}]", yaml), "fault", problems);
  if (!document) return std::nullopt;
  World with_it = world;
  with_it.faults.clear();
  read_fields(
      *document, [&](Fields& fields) { fields.list("faults", with_it.faults, describe_fault, "faults"); },
      problems);
  check_faults(*document, with_it, problems);
  if (!problems.empty() || with_it.faults.size() != 1) return std::nullopt;
  return with_it.faults.front();
}

}  // namespace worlds
