#include "harness/stress/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/stress/stress_plot.hpp"
#include "harness/stress/stress_report.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

struct StressArguments {
  StressPlan plan;
  std::string pattern = "serpentine";
  std::vector<std::string> estimators = {"seif", "ekf"};
  std::vector<std::string> limits;  // name=landmarks
  OutputArguments output;
};

/// Refuses a name that is no type of estimator. A name that --set describes passes: the loader checks it.
void check_name(const StressArguments& arguments, const seif::Registry& registry, std::string_view option,
                const std::string& name) {
  const std::string key = "estimators." + name;
  const auto describes_it = [&](const std::string& value) {
    return value.starts_with("estimators=") || value.starts_with(key + "=") ||
           value.starts_with(key + ".type=");
  };
  if (registry.find(name) == nullptr && std::ranges::none_of(arguments.plan.overrides, describes_it))
    throw no_such_estimator(registry, option, name);
}

void read_limits(StressArguments& arguments, const seif::Registry& registry) {
  for (const std::string& limit : arguments.limits) {
    const std::size_t equals = limit.find('=');
    const std::string_view number = std::string_view(limit).substr(equals + 1);  // npos + 1 is 0
    std::int64_t landmarks = -1;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), landmarks);
    const bool is_whole = error == std::errc() && end == number.data() + number.size();
    if (equals == std::string::npos || equals == 0 || !is_whole || landmarks < 0)
      throw BadInput(fmt::format("--limit: '{}' is not like ekf=2000", limit));
    const std::string name = limit.substr(0, equals);
    check_name(arguments, registry, "--limit", name);
    arguments.plan.most_landmarks[name] = landmarks;
  }
}

int stress_worlds(StressArguments arguments, const seif::Registry& registry) {
  StressPlan& plan = arguments.plan;
  read_limits(arguments, registry);
  for (const std::string& name : arguments.estimators) check_name(arguments, registry, "--estimators", name);
  if (!plan.reference.empty()) check_name(arguments, registry, "--reference", plan.reference);
  if (plan.places > plan.updates)
    throw BadInput(fmt::format("--places: {} places for {} updates", plan.places, plan.updates));
  const auto* pattern = std::ranges::find(stress_pattern_names, std::string_view(arguments.pattern));
  plan.world.pattern = static_cast<StressPattern>(pattern - stress_pattern_names.begin());
  plan.world.estimators = arguments.estimators;
  plan.quiet = arguments.output.quiet || arguments.output.json;
  std::ranges::sort(plan.landmarks);
  plan.landmarks.erase(std::unique(plan.landmarks.begin(), plan.landmarks.end()), plan.landmarks.end());
  plan.folder = make_folder(arguments.output, "stress");

  const StressResult result = stress(plan, registry);
  const std::string json = to_json(plan, result);
  write_whole_file(plan.folder / "stress.json", json);
  const std::string complaint = draw_scaling(scaling_of(result.rows), plan.folder);
  if (!complaint.empty()) tell_warning(complaint);
  const std::string tables = stress_tables(plan, result);
  write_whole_file(plan.folder / "stress.txt", tables);
  return print_output(arguments.output, json, tables, plan.folder, result.interrupted ? 130 : 0);
}

void add_options(CLI::App& command, StressArguments& arguments) {
  StressPlan& plan = arguments.plan;
  command.add_option("--landmarks", plan.landmarks, "Numbers of landmarks, one world for each")
      ->delimiter(',')
      ->check(whole_number(100, 10'000'000))
      ->capture_default_str();
  command
      .add_option("--estimators", arguments.estimators,
                  "Types of estimators; options by --set estimators.NAME")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--reference", plan.reference,
                     "An estimator for the map errors to be compared with: batch, the least-squares optimum");
  command.add_option("--density", plan.world.density, "Landmarks for each square metre")
      ->check(number_between(0.01, 0.3))
      ->capture_default_str();
  command.add_option("--updates", plan.updates, "Updates that are measured, five in a simulated second")
      ->check(whole_number(10, 10'000'000))
      ->capture_default_str();
  command
      .add_option("--places", plan.places,
                  "Places along a second round that share these updates; 1: where the warm start has ended")
      ->check(whole_number(1, 1'000))
      ->capture_default_str();
  command.add_option("--pattern", arguments.pattern, "serpentine, ring or forest")
      ->check(one_of({stress_pattern_names.begin(), stress_pattern_names.end()}))
      ->capture_default_str();
  command.add_option("--limit", arguments.limits,
                     "The most landmarks for an estimator: ekf=5000, eif=500, batch=50000 (the defaults)");
  command
      .add_option("--slowest", plan.slowest_ms,
                  "What an update may take in a warm start before its estimator is given up [ms]")
      ->check(positive_number(1e6))
      ->capture_default_str();
  command.add_option("--seed", plan.world.seed, "Seed of everything that is random")
      ->check(seed_number())
      ->type_name("INT")
      ->capture_default_str();
  command.add_option("--set", plan.overrides, "Set a value of the world files: path.to.key=value")
      ->allow_extra_args(false);
  add_output_options(command, arguments.output, "runs/stress", "stress.json instead of the tables");
}

}  // namespace

void add_stress(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "stress", "Measure what everything costs, live in Bullet, as the map grows to 100,000 landmarks");
  command->footer(
      "Examples:\n"
      "  seifbed stress\n"
      "  seifbed stress --landmarks 1000,100000 --updates 5000 --estimators seif\n"
      "  seifbed stress --landmarks 10000 --estimators seif --reference batch\n"
      "  seifbed stress --pattern forest --set estimators.seif.theta_x=16\n"
      "  seifbed stress --landmarks 100,1000 --json | jq .slopes\n"
      "Each filter first maps its world with the engine without contacts; then the same filter goes on live\n"
      "in Bullet, here and there on a second round, and that is measured.\n"
      "docs/stress.md describes the tables.");
  auto arguments = std::make_shared<StressArguments>();
  add_options(*command, *arguments);
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return stress_worlds(*arguments, registry); });
  });
}

}  // namespace harness
