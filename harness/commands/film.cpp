#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/film/film_folder.hpp"
#include "harness/film/film_options.hpp"
#include "harness/film/frame_sink.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

struct FilmArguments {
  std::string folder;
  std::vector<std::string> overrides;
  FilmOptions film;
  bool force = false;  // replaces files that are there already
  bool quiet = false;
};

std::filesystem::path file_of(const FilmArguments& arguments) {
  if (!arguments.film.out.empty()) return arguments.film.out;
  return free_file(arguments.folder, arguments.film.at ? "frame.png" : "film.mp4");
}

int film(const FilmArguments& arguments, const seif::Registry& registry) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::string> overrides = arguments.overrides;
  for (const std::string& override : film_overrides(arguments.film)) overrides.push_back(override);
  std::vector<worlds::Problem> problems;
  const TemporaryFolder spare;
  const std::filesystem::path log = whole_log(arguments.folder, spare.path());
  std::optional<FilmableFolder> folder = prepare_film(log, overrides, registry, problems);
  if (!folder) {
    print_problems(problems);
    return 2;
  }
  const bool is_still = arguments.film.at.has_value();
  const worlds::Film& settings = folder->plan.world.film;
  folder->plan.clock = film_clock(settings, folder->plan.start, folder->plan.end,
                                  is_still ? arguments.film.at : arguments.film.from,
                                  is_still ? arguments.film.at : arguments.film.to);
  // A single picture has the frame that it would have in a film of the whole run.
  folder->plan.path = is_still ? path_area(log, folder->plan.start, folder->plan.end)
                               : path_area(log, folder->plan.clock.start, folder->plan.clock.end);
  const std::filesystem::path file = file_of(arguments);
  check_frame_sink(file, is_still, arguments.force ? Existing::replace : Existing::keep);
  const Clock::time_point begin = Clock::now();
  const FilmResult result = film_folder(
      *folder, log, make_frame_sink(file, {settings.width, settings.height, settings.fps}, is_still),
      arguments.quiet);
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
  const int code = result.interrupted ? 130 : 0;
  if (result.frames == 0) {
    tell_error("seifbed: interrupted before the first frame: there is no film");
    return code;
  }
  if (arguments.quiet) return code;
  const auto frames = static_cast<double>(result.frames);
  const std::string length = is_still ? std::string()
                                      : fmt::format(": {:.1f} s, {} frames, {:.1f} drawn in a second",
                                                    frames / settings.fps, result.frames, frames / elapsed);
  return print_all(fmt::format("Written to {}{}\n", files_of(file, is_still, result.frames), length), code);
}

}  // namespace

void add_film(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("film", "Film a run: the world, and what the estimators believe of it");
  command->footer(
      "Examples:\n"
      "  seifbed film runs/courtyard-1\n"
      "  seifbed film runs/courtyard-1 --camera chase --from 60 --to 90 --speed 2 --out chase.mp4\n"
      "  seifbed film runs/courtyard-1 --estimators seif,seif_report --hide rays,odometry --out two.webm\n"
      "  seifbed film runs/courtyard-1 --at 45 --size 1920x1080 --out frame.png\n"
      "Nothing is simulated again: the filters are fed with the recorded log. The estimators that are not\n"
      "named are seif and ekf if they ran. A run's world.yaml says how it is filmed unless an option does.\n"
      "Ctrl-C ends the film where it is; what there is can be played.");
  auto arguments = std::make_shared<FilmArguments>();
  command->add_option("RUN", arguments->folder, "Folder of a run or of any other log")->required();
  add_film_options(*command, arguments->film);
  command->add_option("--set", arguments->overrides, "Set a value of the film section: film.key=value")
      ->allow_extra_args(false);
  command->add_flag("--force", arguments->force, "Replace files that are there already");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return film(*arguments, registry); });
  });
}

}  // namespace harness
