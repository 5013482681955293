#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "harness/commands/commands.hpp"

namespace harness {

namespace {

std::string text_of(const seif::OptionValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// The limits of an option's value, if it has any.
std::string limits_of(const seif::OptionSpec& option) {
  if (!option.choices.empty()) return fmt::format(", one of {}", fmt::join(option.choices, ", "));
  std::string limits;
  if (std::isfinite(option.min)) limits += fmt::format(", at least {}", option.min);
  if (std::isfinite(option.max)) limits += fmt::format(", at most {}", option.max);
  return limits;
}

int list_estimators(const seif::Registry& registry) {
  for (const seif::EstimatorType& type : registry.types()) {
    fmt::print("{}\n  {}\n", type.name, type.help);
    for (const seif::OptionSpec& option : type.options) {
      fmt::print("  {} (default {}{})\n      {}\n", option.key, text_of(option.fallback), limits_of(option),
                 option.help);
    }
    fmt::print("\n");
  }
  return 0;
}

}  // namespace

void add_estimators(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("estimators", "List the types of estimators and their options");
  command->footer(
      "Example:\n"
      "  seifbed estimators\n"
      "In a world file, under names of your own:\n"
      "  estimators:\n"
      "    ekf: {}\n"
      "    careful: {type: ekf, odometry_sd_factor: 2}");
  command->callback([&registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return list_estimators(registry); });
  });
}

}  // namespace harness
