#include <memory>
#include <string>
#include <vector>

#include "harness/commands/commands.hpp"
#include "harness/estimators/calibration.hpp"
#include "harness/terminal/checks.hpp"

namespace harness {

namespace {

struct CalibrateArguments {
  std::vector<std::string> logs;
  std::vector<int> robots;
  std::string format;
};

/// The start of the search: errors of a few per cent.
const LogNoise guess{.odometry = OdometryNoise{0.05, 0.02, 0.05, 0.05},
                     .sensor = SensorNoise{0.1, 0.02, 0.02}};

int calibrate(const CalibrateArguments& arguments) {
  std::vector<CalibrationLog> logs;
  const auto add = [&](const LogChoice& choice) { logs.push_back(read_for_calibration(*open_log(choice))); };
  for (const std::string& log : arguments.logs) {
    if (arguments.robots.empty()) add({.path = log, .format = arguments.format});
    for (const int robot : arguments.robots) add({.path = log, .format = arguments.format, .robot = robot});
  }
  return print_all(to_yaml(harness::calibrate(logs, guess)), 0);
}

}  // namespace

void add_calibrate(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "calibrate", "Estimate the noise of odometry and sensor from logs with known landmarks");
  command->footer(
      "Examples:\n"
      "  seifbed calibrate runs/courtyard-1 > noise.yaml\n"
      "  seifbed calibrate MRCLAM_Dataset6 --robot 1,2,3,4,5 > noise.yaml\n"
      "  seifbed replay MRCLAM_Dataset4 --robot 3 --noise noise.yaml\n"
      "The noise is that under which the innovations of a filter on the true map are most likely. How, and\n"
      "what the values mean, is described in docs/datasets.md.");
  auto arguments = std::make_shared<CalibrateArguments>();
  command->add_option("LOG", arguments->logs, "One or more logs, of one robot or of robots alike")
      ->required();
  command
      ->add_option("--robot", arguments->robots, "Which robots of an MRCLAM folder, as 1,2,3; 1 by default")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_number(1, most_robots));
  command->add_option("--format", arguments->format, "Format of the logs; by default told by their content")
      ->check(one_of(log_format_names()));
  command->callback([=, &code = line.exit_code] { code = guarded([&] { return calibrate(*arguments); }); });
}

}  // namespace harness
