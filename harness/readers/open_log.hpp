// Logs of all formats: which one it is, and a stream of it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/readers/log_noise.hpp"
#include "harness/stream/recorded_log.hpp"

namespace harness {

enum class LogFormat {
  own,           // a folder as docs/log_format.md describes it
  mrclam,        // a folder of the UTIAS multi-robot data sets
  graph,         // poses and landmarks, of iSAM or g2o
  freiburg,      // sensor_data.dat
  victoria_park  // car odometry and trees
};

/// A log, as the command line says it.
struct LogChoice {
  std::filesystem::path path = {};
  std::string format = {};                          // empty: told by the content
  std::optional<int> robot = {};                    // of MRCLAM; 1 if left out
  std::optional<std::filesystem::path> truth = {};  // of graphs: the same graph without noise
  NoiseChoices noise = {};
};

/// The names that a format may be given by.
std::vector<std::string> log_format_names();

/// Throws BadInput if the content is of no format that is known.
LogFormat format_of(const LogChoice& choice);

/// Throws BadInput: `file:line:column: reason`, or what does not fit the format.
std::unique_ptr<RecordedLog> open_log(const LogChoice& choice);

/// The noise that is taken for a log of this format unless it is told otherwise; nothing for what the log
/// says itself.
LogNoise default_noise(LogFormat format);

/// The settings with which a log that comes without is replayed, as YAML: estimators with their options.
std::string default_settings(LogFormat format);

}  // namespace harness
