#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/exports/graph.hpp"
#include "harness/exports/trajectories.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/terminal/checks.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

struct ExportArguments {
  std::string run;
  std::string format;
  std::string estimator;  // empty: the first
  std::string out;        // empty: stdout
  bool force = false;
};

/// The estimator that was asked for, or the first one. The names in `others` are allowed too.
std::string choose_estimator(const std::string& asked, const std::vector<std::string>& names,
                             const std::vector<std::string>& others) {
  if (names.empty() && asked.empty()) throw BadInput("--estimator: the run has none");
  if (asked.empty()) return names.front();
  const auto has = [&](const std::vector<std::string>& all) {
    return std::ranges::find(all, asked) != all.end();
  };
  if (has(names) || has(others)) return asked;
  throw BadInput(fmt::format("--estimator: the run has no '{}'; it has {}", asked, fmt::join(names, ", ")));
}

std::string exported(const ExportArguments& arguments) {
  const std::filesystem::path run = arguments.run;
  std::vector<std::string> names;
  for (const EstimatorScore& estimator : read_summary(run / "summary.json").score.estimators)
    names.push_back(estimator.name);
  if (arguments.format == "csv") {
    if (!arguments.estimator.empty()) names = {choose_estimator(arguments.estimator, names, {})};
    return trajectories_csv(run, names);
  }
  if (arguments.format == "g2o" || arguments.format == "gtsam") {
    const RecordedGraph graph = read_graph(run, choose_estimator(arguments.estimator, names, {}));
    return arguments.format == "g2o" ? to_g2o(graph) : to_gtsam(graph);
  }
  return read_whole_file(run /
                         (choose_estimator(arguments.estimator, names, {"truth", "odometry"}) + ".tum"));
}

int export_run(const ExportArguments& arguments) {
  const std::string text = exported(arguments);
  if (arguments.out.empty()) {
    print_data(text);
    return 0;
  }
  write_whole_file(arguments.out, text, arguments.force ? Existing::replace : Existing::keep);
  return 0;
}

}  // namespace

void add_export(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("export", "Write a run in a format that other programs read");
  command->footer(
      "Examples:\n"
      "  seifbed export runs/loop-1 --format g2o --estimator ekf --out loop.g2o\n"
      "  seifbed export runs/loop-1 --format tum --estimator truth > truth.tum\n"
      "  seifbed export runs/loop-1 --format csv > trajectories.csv\n"
      "g2o: poses, landmarks and what was measured, with information matrices; gtsam: the same for GTSAM;\n"
      "tum: one trajectory, for evo; csv: all trajectories side by side. docs/log_format.md describes them.");
  auto arguments = std::make_shared<ExportArguments>();
  command->add_option("RUN", arguments->run, "Folder of a run or of a replay")->required();
  command->add_option("--format", arguments->format, "tum, g2o, gtsam or csv")
      ->required()
      ->check(one_of({"tum", "g2o", "gtsam", "csv"}));
  command->add_option(
      "--estimator", arguments->estimator,
      "Whose poses and landmarks; by default the first, with csv all; with tum also truth and "
      "odometry");
  command->add_option("--out", arguments->out, "File to write; by default it is printed");
  command->add_flag("--force", arguments->force, "Replace the file if it is there already");
  command->callback([=, &code = line.exit_code] { code = guarded([&] { return export_run(*arguments); }); });
}

}  // namespace harness
