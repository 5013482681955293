#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "targets.hpp"
#include "worlds/merge.hpp"

namespace fuzz {

namespace {

worlds::Node base() {
  std::vector<worlds::Problem> problems;
  return *worlds::parse_document(
      "seed: 1\nsensors: {landmark_sensor: {range_sd_m: 0.1}}\n"
      "drive: {waypoints_m: [[1, 2], [3, 4]]}\nestimators: {ekf: {}, seif: {theta_x: 6}}\nname: null\n",
      "base", problems);
}

}  // namespace

void read_override(std::string_view bytes) {
  worlds::Node document = base();
  const std::string before = worlds::emit(document);
  std::vector<worlds::Problem> problems;
  worlds::apply_override(document, std::string(bytes), problems);
  const std::string after = worlds::emit(document);
  if (!problems.empty()) return;
  std::vector<worlds::Problem> none;
  const std::optional<worlds::Node> again = worlds::parse_document(after, "again", none);
  if (!again || worlds::emit(*again) != after) std::abort();
}

}  // namespace fuzz
