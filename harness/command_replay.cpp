#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/commands.hpp"
#include "harness/csv_reader.hpp"
#include "harness/csv_writer.hpp"
#include "harness/estimator_schemas.hpp"
#include "harness/log_stream.hpp"
#include "harness/run_folder.hpp"
#include "harness/version.hpp"
#include "worlds/describe.hpp"
#include "worlds/merge.hpp"

namespace harness {

namespace {

struct ReplayArguments {
  std::string folder;
  std::vector<std::string> estimators;
  std::vector<std::string> overrides;
  std::string seed;  // checked as part of the settings; empty: the run's
  std::string out;
  bool json = false;
  bool quiet = false;
};

/// What a replay takes from a world file: estimators, scoring and seed. The rest stands in the log.
struct ReplaySettings {
  worlds::World world;
  std::string resolved;  // YAML
};

/// What a log of other origin is fed to, unless the command line says otherwise: the baseline, and the
/// report's filter in constant time. Some of the other filters would take hours over a long log.
constexpr const char* default_settings = "estimators: {ekf: {}, seif_report: {}}";

/// The document of the run that wrote the log.
std::optional<worlds::Node> read_settings(const std::filesystem::path& folder,
                                          std::vector<worlds::Problem>& problems) {
  if (std::filesystem::exists(folder / "world.yaml"))
    return worlds::read_document(folder / "world.yaml", problems);
  return worlds::parse_document(default_settings, "settings", problems);
}

void check_override(const std::string& assignment) {
  if (assignment.starts_with("estimators.") || assignment.starts_with("scoring.") ||
      assignment.starts_with("seed="))
    return;
  throw BadInput(fmt::format("--set {}: a replay can set estimators, scoring and seed; the rest is recorded",
                             assignment));
}

/// Leaves the estimators that were asked for, in the order of the file; a registered type that is missing
/// comes in with its defaults.
void select_estimators(worlds::Node& document, const std::vector<std::string>& names,
                       const seif::Registry& registry, std::vector<worlds::Problem>& problems) {
  if (names.empty()) return;
  for (const std::string& name : names) {
    if (worlds::find_path(document, "estimators." + name) != nullptr) continue;
    if (registry.find(name) == nullptr)
      throw BadInput(fmt::format("--estimators: there is no estimator '{}'", name));
    worlds::apply_override(document, fmt::format("estimators.{}={{}}", name), problems);
  }
  worlds::Node* estimators = document.find("estimators");
  if (estimators == nullptr) return;
  std::erase_if(estimators->entries, [&](const worlds::Node::Entry& entry) {
    return std::ranges::find(names, entry.key) == names.end();
  });
}

/// Nothing if there are problems; they are printed.
std::optional<ReplaySettings> load_settings(const ReplayArguments& arguments,
                                            const seif::Registry& registry) {
  std::vector<worlds::Problem> problems;
  std::optional<worlds::Node> document = read_settings(arguments.folder, problems);
  worlds::WorldFile file;
  if (document) {
    for (const std::string& assignment : arguments.overrides) {
      check_override(assignment);
      worlds::apply_override(*document, assignment, problems);
    }
    if (!arguments.seed.empty()) worlds::apply_override(*document, "seed=" + arguments.seed, problems);
    select_estimators(*document, arguments.estimators, registry, problems);
    const worlds::EstimatorSchemas schemas = estimator_schemas(registry);
    worlds::read_fields(
        *document, [&](worlds::Fields& fields) { worlds::describe_world(fields, file, schemas); }, problems);
  }
  if (!problems.empty()) {
    print_problems(problems);
    return std::nullopt;
  }
  return ReplaySettings{file.world, worlds::emit(*document)};
}

int replay(const ReplayArguments& arguments, const seif::Registry& registry) {
  LogStream stream(arguments.folder);
  const LogDescription& log = stream.description();
  const std::optional<ReplaySettings> settings = load_settings(arguments, registry);
  if (!settings) return 2;
  const worlds::World& world = settings->world;

  Believers believers;
  believers.estimators = make_estimators(registry, world.estimators, log, world.seed);
  RunPlan plan;
  plan.folder = arguments.out.empty() ? create_run_folder("runs", file_name_of(log.name) + "-replay")
                                      : create_empty_folder(arguments.out);
  plan.name = log.name;
  plan.seed = world.seed;
  plan.scoring = world.scoring;
  plan.quiet = arguments.quiet || arguments.json;
  const std::filesystem::path source = arguments.folder;
  if (std::filesystem::exists(source / "world.yaml")) {
    write_whole_file(plan.folder / "world.yaml", settings->resolved);
    if (std::filesystem::exists(source / "commands.csv"))
      std::filesystem::copy_file(source / "commands.csv", plan.folder / "commands.csv");
  }
  return print_result(execute(stream, log, believers, plan), plan.folder, arguments.json, arguments.quiet);
}

}  // namespace

void add_replay(CommandLine line) {
  CLI::App* command =
      line.app.add_subcommand("replay", "Feed a recorded log, such as a run folder, to estimators");
  command->footer(
      "Examples:\n"
      "  seifbed replay runs/courtyard-1\n"
      "  seifbed replay runs/courtyard-1 --estimators ekf --set estimators.ekf.odometry_sd_factor=2\n"
      "  seifbed replay my_log --estimators ekf,seif_report --out /tmp/mine\n"
      "A folder with a world.yaml is replayed with the estimators and options that stand there;\n"
      "any other with ekf and seif_report. The log format is described in docs/log_format.md.");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("FOLDER", arguments->folder, "Log folder")->required();
  command->add_option("--estimators", arguments->estimators, "Only these: names from world.yaml, or types")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--set", arguments->overrides,
                   "Set a value of estimators, scoring or seed: path.to.key=value")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed of the estimators that draw")->type_name("INT");
  command->add_option("--out", arguments->out, "Folder to write to; by default a new one, runs/<log>-replay");
  command->add_flag("--json", arguments->json, "Print summary.json instead of the scoreboard");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return replay(*arguments, registry); });
  });
}

}  // namespace harness
