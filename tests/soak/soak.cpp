// Runs random worlds, one after the other, for the given time: soak --minutes 60 --seed 1
// Exits with 1 if a property that must hold is violated, and prints the world's text and seed, so that the case
// can be repeated.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/stress/resident_memory.hpp"
#include "invariants.hpp"
#include "random_world.hpp"
#include "worlds/load.hpp"

namespace {

struct Tally {
  int worlds = 0;  // [-] worlds that were run
  int without_room = 0;
  int failures = 0;  // [-] estimators that failed and reported it
  int diverged = 0;  // [-] estimators that reported it
  int broken = 0;    // [-] worlds with a violated property
  double updates = 0.0;
  std::vector<double> resident;  // [byte] after each world
};

std::optional<worlds::World> load(const std::string& text) {
  static const seif::Registry registry = harness::known_estimators();
  static const worlds::EstimatorSchemas schemas = harness::estimator_schemas(registry);
  const harness::TemporaryFolder folder;
  std::ofstream(folder / "world.yaml") << text;
  return worlds::load_world(folder / "world.yaml", {}, schemas).world;
}

harness::RunResult run(const worlds::World& world, std::vector<std::string>& broken) {
  harness::PreparedRun prepared = harness::prepare_run(world, harness::known_estimators());
  soak::Invariants invariants(*prepared.believers);
  harness::RunResult result = harness::execute_in_passing(prepared, &invariants);
  broken = invariants.broken();
  if (!result.error.empty() && result.error.find("steers") == std::string::npos)
    broken.push_back(result.error);
  return result;
}

void soak_one(std::uint64_t seed, bool twice, Tally& tally) {
  const std::string text = soak::random_world(seed);
  const std::optional<worlds::World> world = load(text);
  if (!world) {
    ++tally.without_room;
    return;
  }
  std::vector<std::string> broken;
  const harness::RunResult result = run(*world, broken);
  std::vector<std::string> ignored;
  if (twice && run(*world, ignored).summary.trajectory_hash != result.summary.trajectory_hash)
    broken.emplace_back("a second run did not come to the same bits");
  ++tally.worlds;
  tally.updates += static_cast<double>(result.summary.updates);
  for (const std::string& failure : result.summary.failures) tally.failures += failure.empty() ? 0 : 1;
  for (std::size_t i = 0; i < result.summary.failures.size(); ++i) {
    if (!result.summary.failures[i].empty())
      fmt::print("seed {}: {} failed {}\n", seed, result.summary.score.estimators[i].name,
                 result.summary.failures[i]);
  }
  for (const harness::EstimatorScore& score : result.summary.score.estimators)
    tally.diverged += score.diverged_t ? 1 : 0;
  tally.resident.push_back(harness::resident_bytes());
  if (broken.empty()) return;
  ++tally.broken;
  for (const std::string& what : broken) fmt::print("seed {}: {}\n", seed, what);
  fmt::print("{}\n", text);
}

/// Whether memory is not larger at the end than after the first tenth of the worlds, apart from the share of
/// the largest world.
bool memory_is_flat(const std::vector<double>& resident) {
  constexpr double slack = 32.0 * (1 << 20);  // [byte]
  constexpr std::size_t enough = 20;
  if (resident.size() < enough) return true;
  const std::size_t begin = resident.size() / 10;
  const std::size_t tenth = std::max<std::size_t>(1, resident.size() / 10);
  const double early = *std::min_element(resident.begin() + static_cast<std::ptrdiff_t>(begin),
                                         resident.begin() + static_cast<std::ptrdiff_t>(begin + tenth));
  const double late = *std::min_element(resident.end() - static_cast<std::ptrdiff_t>(tenth), resident.end());
  fmt::print("memory: {:.1f} MiB after the first tenth, {:.1f} MiB at the end\n", early / (1 << 20),
             late / (1 << 20));
  return late <= early + slack;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Runs random worlds and checks what must hold of all of them."};
  double minutes = 0.0;
  int worlds = 0;
  std::uint64_t seed = 1;
  app.add_option("--minutes", minutes, "for so long");
  app.add_option("--worlds", worlds, "or so many");
  app.add_option("--seed", seed, "of the first world; the others count on from there");
  CLI11_PARSE(app, argc, argv);

  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Tally tally;
  const int most = 20 * std::max(worlds, 1);
  for (int i = 0; worlds > 0 ? tally.worlds < worlds && i < most : elapsed() < 60.0 * minutes; ++i) {
    constexpr int each = 5;  // one of this number of worlds is run twice
    soak_one(seed + static_cast<std::uint64_t>(i), i % each == 0, tally);
  }
  const bool flat = memory_is_flat(tally.resident);
  fmt::print(
      "{} worlds, {:.0f} updates, {:.0f} s; {} without room; {} estimators failed, {} diverged, and said so; "
      "{} worlds in which something did not hold\n",
      tally.worlds, tally.updates, elapsed(), tally.without_room, tally.failures, tally.diverged,
      tally.broken);
  return tally.broken == 0 && flat && tally.worlds > 0 && (worlds == 0 || tally.worlds == worlds) ? 0 : 1;
}
