#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "harness/commands.hpp"
#include "harness/csv_reader.hpp"
#include "harness/replay_settings.hpp"
#include "harness/run_folder.hpp"
#include "harness/score/details.hpp"
#include "harness/scoreboard.hpp"

namespace harness {

namespace {

struct ScoreArguments {
  std::string folder;
  DetailChoices details;
  bool every_update = false;
  bool json = false;
};

/// Replays the run, with its consistency scored after every update.
void replay_into(const std::filesystem::path& to, const std::filesystem::path& run_folder,
                 const std::vector<std::string>& estimators, const Summary& summary,
                 const seif::Registry& registry) {
  constexpr double shorter_than_any = 1e-6;  // [s]
  const worlds::LoadResult settings =
      load_replay_settings(run_folder, {estimators, {}, fmt::format("{}", summary.seed)}, registry);
  if (!settings.world) throw BadInput(worlds::to_string(settings.problems.front()));
  PreparedRun run = prepare_replay(run_folder, *settings.world, registry);
  run.plan.folder = to;
  run.plan.scoring.interval = shorter_than_any;
  const RunResult result = execute(run);
  if (result.summary.interrupted) throw std::runtime_error("interrupted");
  if (result.summary.trajectory_hash != summary.trajectory_hash)
    throw std::runtime_error(
        fmt::format("{}: does not replay to the same estimates; it was made by version {}",
                    run_folder.string(), summary.version));
}

int score(const ScoreArguments& arguments, const seif::Registry& registry) {
  const std::filesystem::path folder = arguments.folder;
  Summary summary = read_summary(folder / "summary.json");
  std::vector<std::string> names;
  for (const EstimatorScore& estimator : summary.score.estimators) names.push_back(estimator.name);
  summary.score = score_folder(folder, names, summary.rpe_interval);
  DetailChoices choices = arguments.details;
  std::optional<TemporaryFolder> replayed;
  if (arguments.every_update) {
    choices.consistency = replayed.emplace().path();
    replay_into(choices.consistency, folder, names, summary, registry);
  }
  const RunDetails details = score_details(folder, names, choices);
  if (arguments.json) return print_all(to_json(summary, details), 0);
  return print_all(scoreboard(summary) + '\n' + details_board(details), 0);
}

}  // namespace

void add_score(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("score", "Score a run again, in more detail, from its folder");
  command->footer(
      "Examples:\n"
      "  seifbed score runs/courtyard-1\n"
      "  seifbed score runs/loop-1 --rpe-m 1,10,100 --away-s 60\n"
      "  seifbed score runs/report2002-1 --every-update --json | jq .estimators.ekf.nees_pose_inside\n"
      "Nothing is simulated. What the scores mean is described in docs/scores.md.");
  auto arguments = std::make_shared<ScoreArguments>();
  command->add_option("RUN", arguments->folder, "Folder of a run or of a replay")->required();
  command
      ->add_option("--rpe-m", arguments->details.distances,
                   "Distances of the relative pose error along the path [m]; by default 1,5,10")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--away-s", arguments->details.away,
          "How long a landmark was out of sight when seeing it again closes a loop [s]; 20 by default")
      ->check(CLI::PositiveNumber);
  command->add_flag("--every-update", arguments->every_update,
                    "Take the NEES after every update, and not at the scoring times alone: replays the run");
  command->add_flag("--json", arguments->json, "Print it as JSON");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return score(*arguments, registry); });
  });
}

}  // namespace harness
