#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/run/runnable_world.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

struct ValidateArguments {
  std::vector<std::string> files;
  std::vector<std::string> overrides;
  bool json = false;
};

/// Line and column are null where there are none, as in --set.
Json problem_json(const worlds::Problem& problem) {
  const worlds::Location& where = problem.where;
  const auto place = [](int number) { return number > 0 ? Json(number) : Json(nullptr); };
  return {{"file", where.source ? Json(*where.source) : Json(nullptr)},
          {"line", place(where.line)},
          {"column", place(where.column)},
          {"key", problem.path},
          {"message", problem.message}};
}

Json file_json(const std::string& file, const worlds::LoadResult& loaded) {
  Json json = {{"file", file}, {"valid", loaded.world.has_value()}, {"landmarks", nullptr}};
  if (loaded.world) json["landmarks"] = loaded.world->landmarks.size();
  json["problems"] = Json::array();
  for (const worlds::Problem& problem : loaded.problems) json["problems"].push_back(problem_json(problem));
  return json;
}

int validate(const ValidateArguments& arguments, const seif::Registry& registry) {
  int code = 0;
  Json json = {{"valid", true}, {"files", Json::array()}};
  for (const std::string& file : arguments.files) {
    const worlds::LoadResult loaded = load_runnable_world(file, arguments.overrides, registry);
    if (!loaded.world) code = 2;
    if (arguments.json) {
      json["files"].push_back(file_json(file, loaded));
    } else if (loaded.world) {
      print_all(fmt::format("{}: fine, {} landmarks\n", file, loaded.world->landmarks.size()), 0);
    } else {
      print_problems(loaded.problems);
    }
  }
  json["valid"] = code == 0;
  if (!arguments.json) return code;
  return print_all(json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n', code);
}

}  // namespace

void add_validate(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("validate", "Check world files, and say everything that is wrong");
  command->footer(
      "Examples:\n"
      "  seifbed validate worlds/*.yaml\n"
      "  seifbed validate mine.yaml --set landmarks.generators.0.count=500\n"
      "  seifbed validate mine.yaml --json | jq '.files[].problems[].message'");
  auto arguments = std::make_shared<ValidateArguments>();
  command->add_option("FILE", arguments->files, "World files")->required();
  command->add_option("--set", arguments->overrides, "Set a value in each: path.to.key=value")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "Print it as JSON, with each problem's file, line and column");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return validate(*arguments, registry); });
  });
}

}  // namespace harness
