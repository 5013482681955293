#include "harness/readers/open_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/files/row_reader.hpp"
#include "harness/readers/freiburg.hpp"
#include "harness/readers/mrclam.hpp"
#include "harness/readers/pose_landmark_graph.hpp"
#include "harness/readers/victoria_park.hpp"
#include "harness/readers/weighted_log.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {

namespace {

const std::map<std::string, LogFormat>& formats() {
  static const std::map<std::string, LogFormat> all = {{"own", LogFormat::own},
                                                       {"mrclam", LogFormat::mrclam},
                                                       {"graph", LogFormat::graph},
                                                       {"freiburg", LogFormat::freiburg},
                                                       {"victoria_park", LogFormat::victoria_park}};
  return all;
}

constexpr const char* freiburg_file = "sensor_data.dat";

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw BadInput(fmt::format("{}: {}; known formats are {}", path.string(), reason,
                             fmt::join(log_format_names(), ", ")));
}

LogFormat format_of_folder(const std::filesystem::path& folder) {
  if (MrclamLog::is_in(folder)) return LogFormat::mrclam;
  if (VictoriaParkLog::is_in(folder)) return LogFormat::victoria_park;
  if (std::filesystem::exists(folder / freiburg_file)) return LogFormat::freiburg;
  return LogFormat::own;
}

/// Recognises the format by the first record.
LogFormat format_of_file(const std::filesystem::path& file) {
  RowReader rows(file, ' ');
  while (rows.next()) {
    const std::string_view word = rows.cell(0);
    if (word.empty() || rows.is_comment()) continue;
    if (word == "SENSOR" || (word == "ODOMETRY" && rows.size() <= 4)) return LogFormat::freiburg;
    for (const std::string_view known :
         {"ODOMETRY", "EDGE2", "LANDMARK", "VERTEX_SE2", "VERTEX_XY", "EDGE_SE2", "EDGE_SE2_XY", "FIX"}) {
      if (word == known) return LogFormat::graph;
    }
    fail(file, fmt::format("'{}' begins no record of a log", word));
  }
  fail(file, "is empty");
}

std::unique_ptr<RecordedLog> open_as(LogFormat format, const LogChoice& choice) {
  if (choice.robot && format != LogFormat::mrclam)
    throw BadInput(fmt::format("{}: --robot is for MRCLAM folders", choice.path.string()));
  if (choice.truth && format != LogFormat::graph)
    throw BadInput(fmt::format("{}: --truth is for graphs", choice.path.string()));
  switch (format) {
    case LogFormat::own:
      return std::make_unique<LogStream>(choice.path);
    case LogFormat::mrclam:
      return std::make_unique<MrclamLog>(choice.path, choice.robot.value_or(1));
    case LogFormat::graph:
      return std::make_unique<PoseLandmarkGraph>(choice.path, choice.truth);
    case LogFormat::freiburg:
      return std::make_unique<FreiburgLog>(
          std::filesystem::is_directory(choice.path) ? choice.path / freiburg_file : choice.path);
    case LogFormat::victoria_park:
      return std::make_unique<VictoriaParkLog>(choice.path);
  }
  fail(choice.path, "is of no format");
}

}  // namespace

std::vector<std::string> log_format_names() {
  std::vector<std::string> names;
  for (const auto& [name, format] : formats()) names.push_back(name);
  return names;
}

LogFormat format_of(const LogChoice& choice) {
  if (!choice.format.empty()) {
    const auto named = formats().find(choice.format);
    if (named == formats().end())
      fail(choice.path, fmt::format("there is no log format '{}'", choice.format));
    return named->second;
  }
  std::error_code error;
  return std::filesystem::is_directory(choice.path, error) || !std::filesystem::exists(choice.path, error)
             ? format_of_folder(choice.path)
             : format_of_file(choice.path);
}

std::unique_ptr<RecordedLog> open_log(const LogChoice& choice) {
  const LogFormat format = format_of(choice);
  std::unique_ptr<RecordedLog> log = open_as(format, choice);
  const LogNoise noise = read_noise(choice.noise, default_noise(format));
  if (!noise.odometry && !noise.sensor) return log;
  return std::make_unique<WeightedLog>(std::move(log), noise);
}

LogNoise default_noise(LogFormat format) {
  switch (format) {
    case LogFormat::mrclam:
      return MrclamLog::default_noise();
    case LogFormat::freiburg:
      return FreiburgLog::default_noise();
    case LogFormat::victoria_park:
      return VictoriaParkLog::default_noise();
    case LogFormat::own:
    case LogFormat::graph:
      break;
  }
  return {};
}

std::string default_settings(LogFormat format) {
  // Some of the other filters would take hours for a long log.
  if (format == LogFormat::own) return "estimators: {ekf: {}, seif: {}, seif_report: {}}";
  if (format == LogFormat::victoria_park) {  // trees without ids, and many false detections
    const std::string chosen = "{association: joint, admit_after: 8, forget_after: 5, remove_below: 0.2}";
    return fmt::format("estimators: {{ekf: {0}, seif: {0}}}", chosen);
  }
  if (format == LogFormat::mrclam)  // some barcodes are misread
    return "estimators: {ekf: {gate: 30}, seif: {gate: 30}}";
  return "estimators: {ekf: {}, seif: {}}";
}

}  // namespace harness
