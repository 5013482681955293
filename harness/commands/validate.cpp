#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/run/runnable_world.hpp"

namespace harness {

namespace {

int validate(const std::vector<std::string>& files, const std::vector<std::string>& overrides,
             const seif::Registry& registry) {
  int code = 0;
  for (const std::string& file : files) {
    const worlds::LoadResult loaded = load_runnable_world(file, overrides, registry);
    if (loaded.world) {
      fmt::print("{}: fine, {} landmarks\n", file, loaded.world->landmarks.size());
    } else {
      print_problems(loaded.problems);
      code = 2;
    }
  }
  return code;
}

}  // namespace

void add_validate(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("validate", "Check world files, and say everything that is wrong");
  command->footer(
      "Examples:\n"
      "  seifbed validate worlds/*.yaml\n"
      "  seifbed validate mine.yaml --set landmarks.generators.0.count=500");
  auto files = std::make_shared<std::vector<std::string>>();
  auto overrides = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", *files, "World files")->required();
  command->add_option("--set", *overrides, "Set a value in each: path.to.key=value")->allow_extra_args(false);
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return validate(*files, *overrides, registry); });
  });
}

}  // namespace harness
