#include "harness/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/readers/open_log.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/overrides.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/run/runnable_world.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

struct LiveArguments {
  LogChoice log;  // its path may be that of a world
  std::vector<std::string> overrides;
  std::string seed;  // checked as part of the world; empty: the file's seed
  std::string speed = "1";
  LiveOptions options;
  bool no_browser = false;
};

/// A world file or the name of a world; anything else is a log.
bool names_world(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return false;
  const std::string extension = path.extension().string();
  return extension == ".yaml" || extension == ".yml" || !std::filesystem::exists(path);
}

double speed_of(const std::string& text) {
  if (text == "max") return std::numeric_limits<double>::infinity();
  char* end = nullptr;
  const double speed = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(speed >= 0.01 && speed <= 10'000.0))
    throw BadInput(fmt::format("--speed must be a number from 0.01 to 10000, or max, not '{}'", text));
  return speed;
}

bool sets_live_noise(const std::string& assignment) { return assignment.starts_with("noise"); }

/// The settings of a log, and the log. Its whole part is copied to `spare` if it is still being written.
std::optional<LiveSource> log_source(LiveArguments arguments, const std::filesystem::path& spare,
                                     const seif::Registry& registry) {
  LogChoice log = std::move(arguments.log);
  log.path = whole_log(log.path, spare);
  std::ranges::copy_if(arguments.overrides, std::back_inserter(log.noise.overrides), sets_live_noise);
  std::erase_if(arguments.overrides, sets_live_noise);
  ReplayChoices choices{{}, arguments.overrides, arguments.seed, default_settings(format_of(log))};
  const bool knows_world = std::filesystem::exists(log.path / "world.yaml");
  const worlds::LoadResult settings =
      knows_world && arguments.overrides.empty() && arguments.seed.empty()
          ? load_runnable_world((log.path / "world.yaml").string(), {}, registry, program_version())
          : load_replay_settings(log.path, choices, registry);
  if (settings.world) return LiveSource{*settings.world, settings.resolved, knows_world, log, registry};
  print_problems(settings.problems);
  return std::nullopt;
}

std::optional<LiveSource> world_source(const LiveArguments& arguments, const seif::Registry& registry) {
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) add_override(overrides, "--seed", "seed", arguments.seed);
  const worlds::LoadResult loaded =
      load_runnable_world(arguments.log.path, overrides, registry, program_version());
  if (loaded.world) {
    refuse_team(*loaded.world, "seifbed live");
    return LiveSource{*loaded.world, loaded.resolved, true, {}, registry};
  }
  print_problems(loaded.problems);
  return std::nullopt;
}

int live(LiveArguments arguments, const seif::Registry& registry) {
  arguments.options.speed = speed_of(arguments.speed);
  arguments.options.opens_browser = !arguments.no_browser;
  const TemporaryFolder spare;
  std::optional<LiveSource> source = names_world(arguments.log.path)
                                         ? world_source(arguments, registry)
                                         : log_source(arguments, spare.path(), registry);
  if (!source) return 2;
  show_live(std::move(*source), arguments.options);
  return 0;
}

}  // namespace

void add_page_options(CLI::App& command, LiveOptions& options) {
  command.add_option("--port", options.port, "Port of the page; by default any free one")
      ->check(whole_number(1, 65535));
  command.add_option(
      "--bind", options.address,
      "Address to listen at; 127.0.0.1 by default: this machine alone. 0.0.0.0: other machines too; "
      "nothing is encrypted, and who knows the token takes hold of the run");
}

void add_live(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "live", "Watch a run in a browser: stop it, step it, take hold of it; what is done can be run again");
  command->footer(
      "Examples:\n"
      "  seifbed live worlds/courtyard.yaml\n"
      "  seifbed live worlds/blackboard.yaml --paused\n"
      "  seifbed live runs/courtyard-1\n"
      "  seifbed live worlds/forest.yaml --speed max --set estimators.seif.theta_max=12\n"
      "It prints an address, and opens it where there is a display. Ctrl-C ends it. What was done is saved "
      "from the\n"
      "page, as a world file and a file of commands: seifbed run gives the same bits again. docs/live.md "
      "says more.");
  auto arguments = std::make_shared<LiveArguments>();
  command->add_option("WORLD|RUN|LOG", arguments->log.path, "World file, folder of a run, or any other log")
      ->required();
  command
      ->add_option("--set", arguments->overrides,
                   "Set a value of the world file, or of the settings of a log: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed of everything that is random")
      ->check(seed_number())
      ->type_name("INT");
  command->add_option("--speed", arguments->speed, "Simulated time over time, or max; 1 by default");
  command->add_flag("--paused", arguments->options.is_paused, "Begin paused");
  add_page_options(*command, arguments->options);
  command->add_flag("--no-browser", arguments->no_browser, "Print the address, and open nothing");
  add_log_options(*command, arguments->log);
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return live(*arguments, registry); });
  });
}

}  // namespace harness
