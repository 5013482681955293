#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"

namespace harness {

namespace {

std::string text_of(const seif::OptionValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// The limits of an option's value, if it has any.
std::string limits_of(const seif::OptionSpec& option) {
  if (!option.choices.empty()) return fmt::format("one of {}", fmt::join(option.choices, ", "));
  std::vector<std::string> limits;
  if (std::isfinite(option.min)) limits.push_back(fmt::format("at least {}", option.min));
  if (std::isfinite(option.max)) limits.push_back(fmt::format("at most {}", option.max));
  if (!option.not_above.empty()) limits.push_back(fmt::format("at most {}", option.not_above));
  return fmt::format("{}", fmt::join(limits, ", "));
}

int list_estimators(const seif::Registry& registry) {
  for (const seif::EstimatorType& type : registry.types()) {
    fmt::print("{}\n  {}\n", type.name, type.help);
    for (const seif::OptionSpec& option : type.options) {
      const std::string limits = limits_of(option);
      fmt::print("  {} (default {}{}{})\n      {}\n", option.key, text_of(option.fallback),
                 limits.empty() ? "" : ", ", limits, option.help);
    }
    fmt::print("\n");
  }
  return 0;
}

constexpr const char* estimators_page_head =
    "# Estimators and their options\n"
    "\n"
    "`seifbed estimators --markdown` writes this page; a test holds it to the program. How the filters work: "
    "[../seif/README.md](../seif/README.md). In a world file, under names of your own:\n"
    "\n"
    "    estimators:\n"
    "      ekf: {}\n"
    "      careful: {type: ekf, odometry_sd_factor: 2}\n";

int print_page(const seif::Registry& registry) {
  fmt::print("{}", estimators_page_head);
  for (const seif::EstimatorType& type : registry.types()) {
    fmt::print("\n## `{}`\n\n{}\n", type.name, type.help);
    if (type.options.empty()) continue;
    fmt::print("\n| option | default | value | meaning |\n|---|---|---|---|\n");
    for (const seif::OptionSpec& option : type.options) {
      fmt::print("| `{}` | `{}` | {} | {} |\n", option.key, text_of(option.fallback), limits_of(option),
                 option.help);
    }
  }
  return 0;
}

}  // namespace

void add_estimators(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("estimators", "List the types of estimators and their options");
  const auto as_markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *as_markdown, "Print tables instead, as docs/estimators.md holds them");
  command->footer(
      "Example:\n"
      "  seifbed estimators\n"
      "In a world file, under names of your own:\n"
      "  estimators:\n"
      "    ekf: {}\n"
      "    careful: {type: ekf, odometry_sd_factor: 2}");
  command->callback([as_markdown, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return *as_markdown ? print_page(registry) : list_estimators(registry); });
  });
}

}  // namespace harness
