// Logs of all formats: finds the format and opens the log as a stream.
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
  own,           // a folder as described in docs/log_format.md
  mrclam,        // a folder of the UTIAS multi-robot dataset
  graph,         // poses and landmarks, from iSAM or g2o
  freiburg,      // sensor_data.dat
  victoria_park  // odometry of a car, and trees
};

/// The log as given on the command line.
struct LogChoice {
  std::filesystem::path path = {};
  std::string format = {};                          // empty: recognised by the content
  std::optional<int> robot = {};                    // for MRCLAM; 1 if empty
  std::optional<std::filesystem::path> truth = {};  // for graphs: the same graph without noise
  NoiseChoices noise = {};
};

/// The names of the formats.
std::vector<std::string> log_format_names();

/// The format of a log. Throws BadInput if the content is of no known format.
LogFormat format_of(const LogChoice& choice);

/// Opens a log. Throws BadInput: `file:line:column: reason`, or an option that does not fit the format.
std::unique_ptr<RecordedLog> open_log(const LogChoice& choice);

/// The default noise for logs of this format; empty where the log gives its own.
LogNoise default_noise(LogFormat format);

/// The default settings for a replay of such a log, as YAML: estimators with their options.
std::string default_settings(LogFormat format);

}  // namespace harness
