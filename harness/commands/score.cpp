#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/run/prepared_run.hpp"
#include "harness/run/rebuilding.hpp"
#include "harness/run/reference.hpp"
#include "harness/run/replay_settings.hpp"
#include "harness/score/details.hpp"
#include "harness/score/foreign.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

constexpr double longest_distance = 1e9;  // [m]
constexpr double longest_time = 1e9;      // [s]

struct ScoreArguments {
  std::filesystem::path folder;
  DetailChoices details;
  std::vector<std::string> references;  // additional estimators to score
  bool every_update = false;
  bool no_replay = false;
  bool json = false;
  ForeignFiles foreign;       // instead of the folder
  double rpe_interval = 1.0;  // [s] of the foreign files
};

/// Rebuilds scores by a replay into an empty folder. There are no such scores if the replay differs from the
/// run, or if the program does not have the run's estimators. If all updates were asked for, this is an
/// error.
std::vector<RebuiltScore> rebuilt_scores(const ScoreArguments& arguments, const Summary& summary,
                                         const std::vector<std::string>& names,
                                         const std::filesystem::path& to, const seif::Registry& registry) {
  constexpr double shorter_than_any = 1e-6;  // [s]
  Rebuilding rebuilding{.run = arguments.folder, .to = to, .estimators = names};
  if (arguments.every_update) rebuilding.interval = shorter_than_any;
  const auto go_without = [&](const std::exception& error) {
    if (arguments.every_update) throw;
    tell_warning(fmt::format("seifbed: no NIS and no NEES from the robot: {}", error.what()));
    return std::vector<RebuiltScore>(names.size());
  };
  try {
    return rebuild(rebuilding, summary, registry);
  } catch (const NotReplayed& error) {
    return go_without(error);
  } catch (const BadInput& error) {
    return go_without(error);
  }
}

/// For a run that was cut off: replays its complete part, to write the files that the run could not write.
void make_whole(const std::filesystem::path& log, const std::filesystem::path& to,
                const seif::Registry& registry) {
  const worlds::LoadResult settings = load_replay_settings(log, {}, registry);
  if (!settings.world) throw BadInput(worlds::to_string(settings.problems.front()));
  PreparedRun replay = prepare_replay(log, *settings.world, registry);
  write_replayed_world(to, log, settings.resolved);
  replay.plan.folder = to;
  replay.plan.quiet = true;
  execute(replay);
}

/// Adds a reference to the scores, or why it is missing. Throws BadInput if it cannot be asked for at all.
void add_reference(const std::string& name, const ScoreArguments& arguments, const seif::Registry& registry,
                   Summary& summary, RunDetails& details) {
  try {
    const ReferenceScore reference =
        score_reference(name, arguments.folder, summary, arguments.details, registry);
    if (is_optimum(name) && details.reference.empty()) {
      details.reference = name;
      for (EstimatorDetails& estimator : details.estimators)
        estimator.from_reference =
            distance_from_reference(arguments.folder, estimator.name, reference.estimate);
    }
    summary.score.estimators.push_back(reference.score);
    summary.failures.emplace_back();
    details.estimators.push_back(reference.details);
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    tell_warning(fmt::format("seifbed: the reference {} is missing: {}", name, error.what()));
    details.missing_references.emplace_back(name, error.what());
  }
}

int score(const ScoreArguments& arguments, const seif::Registry& registry) {
  const std::filesystem::path& folder = arguments.folder;
  Summary summary = read_summary(folder / "summary.json");
  if (!summary.error.empty())
    tell_warning(
        fmt::format("seifbed: {} is of the part before this error: {}", folder.string(), summary.error));
  std::vector<std::string> names;
  for (const EstimatorScore& estimator : summary.score.estimators) names.push_back(estimator.name);
  summary.score = score_folder(folder, names, summary.rpe_interval);
  const TemporaryFolder replayed;
  std::vector<RebuiltScore> rebuilt(names.size());
  if (!arguments.no_replay) rebuilt = rebuilt_scores(arguments, summary, names, replayed.path(), registry);
  DetailChoices choices = arguments.details;
  if (arguments.every_update) choices.consistency = replayed.path();
  RunDetails details = score_details(folder, names, choices);
  for (std::size_t i = 0; i < names.size(); ++i) details.estimators.at(i).rebuilt = rebuilt.at(i);
  for (const std::string& name : arguments.references)
    add_reference(name, arguments, registry, summary, details);
  const int code = details.missing_references.empty() ? 0 : 1;
  if (arguments.json) return print_all(to_json(summary, details), code);
  print_board(scoreboard(summary) + '\n' + details_board(details) + without_truth(folder));
  return code;
}

bool is_foreign(const ScoreArguments& arguments) {
  return !arguments.foreign.trajectory.empty() || !arguments.foreign.map.empty();
}

int score_foreign_files(const ScoreArguments& arguments) {
  const ForeignFiles& files = arguments.foreign;
  if (files.truth.empty() && !files.trajectory.empty())
    throw BadInput("score: --trajectory needs --truth, the folder or the file of the true poses");
  if (files.truth.empty() && files.landmarks.empty())
    throw BadInput(
        "score: --map needs --landmarks, the file of the true landmarks, or --truth, a folder with one");
  if (!files.map.empty() && files.landmarks.empty() && !std::filesystem::is_directory(files.truth))
    throw BadInput("score: --map needs --landmarks, because --truth is no folder");
  const ForeignScore scored = score_foreign(files, arguments.rpe_interval);
  if (arguments.json) return print_all(to_json(scored), 0);
  print_board(foreign_board(scored));
  return 0;
}

int score_any(ScoreArguments arguments, const seif::Registry& registry) {
  if (is_foreign(arguments)) return score_foreign_files(arguments);
  if (arguments.folder.empty())
    throw BadInput("score: RUN is missing, or --trajectory and --truth of another program's result");
  const TemporaryFolder log;
  const TemporaryFolder whole;
  if (is_unfinished(arguments.folder)) {
    make_whole(whole_log(arguments.folder, log.path()), whole.path(), registry);
    arguments.folder = whole.path();
  }
  return score(arguments, registry);
}

/// What another program has estimated, instead of a run.
void add_foreign_options(CLI::App& command, ScoreArguments& arguments) {
  ForeignFiles& files = arguments.foreign;
  const std::vector<CLI::Option*> options = {
      command.add_option(
          "--trajectory", files.trajectory,
          "Instead of RUN: the trajectory of another program, as TUM, or as CSV with t,x,y,theta and "
          "perhaps cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt"),
      command.add_option(
          "--map", files.map,
          "The map of another program, as CSV with landmark,x,y and perhaps cov_xx,cov_xy,cov_yy"),
      command.add_option("--truth", files.truth,
                         "The true poses: the folder of a log or of a run, its truth.csv, or a TUM file"),
      command.add_option("--landmarks", files.landmarks,
                         "The true landmarks, as CSV with landmark,x,y; by default those of the folder")};
  for (CLI::Option* option : options) option->type_name("FILE")->excludes(command.get_option("RUN"));
  command
      .add_option("--rpe-s", arguments.rpe_interval,
                  "Time of the relative pose error of --trajectory [s]; 1 by default")
      ->check(positive_number(longest_time))
      ->needs(options.front());
}

}  // namespace

void add_score(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("score", "Score a run again, in more detail, from its folder");
  command->footer(
      "Examples:\n"
      "  seifbed score runs/courtyard-1\n"
      "  seifbed score runs/loop-1 --rpe-m 1,10,100 --away-s 60\n"
      "  seifbed score runs/report2002-1 --every-update --json | jq .estimators.ekf.nees_pose_inside\n"
      "  seifbed score runs/courtyard-1 --reference batch,mrpt_ekf\n"
      "  seifbed score --trajectory est.tum --map map.csv --truth runs/courtyard-1\n"
      "Nothing is simulated; innovations and joint covariances are rebuilt by a replay. What the scores mean "
      "is described in docs/scores.md.");
  auto arguments = std::make_shared<ScoreArguments>();
  command->add_option("RUN", arguments->folder, "Folder of a run or of a replay");
  command
      ->add_option("--rpe-m", arguments->details.distances,
                   "Distances of the relative pose error along the path [m]; by default 1,5,10")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(positive_number(longest_distance));
  command
      ->add_option(
          "--away-s", arguments->details.away,
          "How long a landmark was out of sight when seeing it again closes a loop [s]; 20 by default")
      ->check(positive_number(longest_time));
  command
      ->add_option(
          "--reference", arguments->references,
          "Rows of others on the same stream: batch, the least-squares optimum of all that was measured; "
          "robust_batch, which trusts outliers less; mrpt_ekf, MRPT's EKF-SLAM, with its times, where this "
          "program was built with it. The first optimum also says how far the others are from it")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({references.begin(), references.end()}));
  CLI::Option* every_update =
      command->add_flag("--every-update", arguments->every_update,
                        "Take NEES and NIS at every update, and not at the scoring times alone");
  command
      ->add_flag("--no-replay", arguments->no_replay,
                 "Leave out what only a replay can tell: NIS, and NEES of landmarks as seen from the robot")
      ->excludes(every_update);
  add_foreign_options(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print it as JSON");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return score_any(*arguments, registry); });
  });
}

}  // namespace harness
