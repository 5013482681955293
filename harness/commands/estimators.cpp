#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

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
  if (option.changeable) limits.emplace_back("can change during a run");
  return fmt::format("{}", fmt::join(limits, ", "));
}

std::string estimators_list(const seif::Registry& registry) {
  std::string text;
  for (const seif::EstimatorType& type : registry.types()) {
    text += fmt::format("{}\n  {}\n", type.name, type.help);
    for (const seif::OptionSpec& option : type.options) {
      const std::string limits = limits_of(option);
      text += fmt::format("  {} (default {}{}{})\n      {}\n", option.key, text_of(option.fallback),
                          limits.empty() ? "" : ", ", limits, option.help);
    }
    text += '\n';
  }
  return text;
}

Json option_json(const seif::OptionSpec& option) {
  const auto limit = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  return {{"key", option.key},
          {"default", std::visit([](const auto& value) { return Json(value); }, option.fallback)},
          {"min", limit(option.min)},
          {"max", limit(option.max)},
          {"changeable", option.changeable},
          {"choices", option.choices.empty() ? Json(nullptr) : Json(option.choices)},
          {"help", option.help}};
}

std::string estimators_json(const seif::Registry& registry) {
  Json json = Json::object();
  for (const seif::EstimatorType& type : registry.types()) {
    Json options = Json::array();
    for (const seif::OptionSpec& option : type.options) options.push_back(option_json(option));
    json[type.name] = {{"help", type.help}, {"options", options}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
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

std::string estimators_page(const seif::Registry& registry) {
  std::string text = estimators_page_head;
  for (const seif::EstimatorType& type : registry.types()) {
    text += fmt::format("\n## `{}`\n\n{}\n", type.name, type.help);
    if (type.options.empty()) continue;
    text += "\n| option | default | value | meaning |\n|---|---|---|---|\n";
    for (const seif::OptionSpec& option : type.options) {
      text += fmt::format("| `{}` | `{}` | {} | {} |\n", option.key, text_of(option.fallback),
                          limits_of(option), option.help);
    }
  }
  return text;
}

struct EstimatorsArguments {
  bool markdown = false;
  bool json = false;
};

int print_estimators(const EstimatorsArguments& arguments, const seif::Registry& registry) {
  if (arguments.json) return print_all(estimators_json(registry), 0);
  return print_all(arguments.markdown ? estimators_page(registry) : estimators_list(registry), 0);
}

}  // namespace

void add_estimators(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("estimators", "List the types of estimators and their options");
  const auto arguments = std::make_shared<EstimatorsArguments>();
  command->add_flag("--markdown", arguments->markdown,
                    "Print tables instead, as docs/estimators.md holds them");
  command->add_flag("--json", arguments->json, "Print it as JSON")->excludes("--markdown");
  command->footer(
      "Examples:\n"
      "  seifbed estimators\n"
      "  seifbed estimators --json | jq '.ekf.options[].key'\n"
      "In a world file, under names of your own:\n"
      "  estimators:\n"
      "    ekf: {}\n"
      "    careful: {type: ekf, odometry_sd_factor: 2}");
  command->callback([arguments, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return print_estimators(*arguments, registry); });
  });
}

}  // namespace harness
