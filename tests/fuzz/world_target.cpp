#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "archive.hpp"
#include "harness/recording/run_folder.hpp"
#include "targets.hpp"
#include "worlds/limits.hpp"
#include "worlds/load.hpp"

namespace fuzz {

namespace {

/// Stand-ins with options of every kind.
worlds::EstimatorSchemas estimators() {
  worlds::EstimatorSchemas schemas;
  schemas.types["ekf"] = [](worlds::Fields& fields, std::map<std::string, worlds::OptionValue>& options) {
    double gate = 0.0;
    fields.number("gate", gate, worlds::at_least(0), "gate");
    options["gate"] = gate;
  };
  schemas.types["seif"] = [](worlds::Fields& fields, std::map<std::string, worlds::OptionValue>& options) {
    std::int64_t theta_x = 6;
    bool exact = false;
    std::string mean = "tree";
    fields.integer("theta_x", theta_x, worlds::at_least(1), "active landmarks");
    fields.boolean("exact", exact, "exact");
    fields.choice("mean_recovery", mean, {"tree", "multilevel"}, "mean");
    options = {{"theta_x", theta_x}, {"exact", exact}, {"mean_recovery", mean}};
  };
  return schemas;
}

worlds::LoadResult load(std::string_view text) {
  static const worlds::EstimatorSchemas schemas = estimators();
  static const harness::TemporaryFolder folder;
  const std::filesystem::path file = folder / "world.yaml";
  write(file, text);
  return worlds::load_world(file, {}, schemas);
}

}  // namespace

void read_world(std::string_view bytes) {
  // The limits for files are tested elsewhere; here large values would only make each run slow.
  worlds::set_limits({.bytes = 1 << 16, .values = 10'000, .landmarks = 2e3, .fruitless_tries = 10'000});
  const worlds::LoadResult first = load(bytes);
  if (first.world.has_value() != first.problems.empty()) std::abort();
  if (!first.world) return;
  const worlds::LoadResult again = load(first.resolved);
  if (!again.world || again.resolved != first.resolved) std::abort();
  if (again.world->landmarks.size() != first.world->landmarks.size()) std::abort();
}

}  // namespace fuzz
