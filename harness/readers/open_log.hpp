// Recognises the format of a log, and opens it as a stream.
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

/// A log as chosen on the command line.
struct LogChoice {
  std::filesystem::path path = {};
  std::string format = {};                          // empty: told by the content
  std::optional<int> robot = {};                    // of MRCLAM; 1 if left out
  std::optional<std::filesystem::path> truth = {};  // of graphs: the same graph without noise
  NoiseChoices noise = {};
};

/// The names of the formats.
std::vector<std::string> log_format_names();

/// Throws BadInput if the content has no known format.
LogFormat format_of(const LogChoice& choice);

/// Throws BadInput: `file:line:column: reason`, or what does not fit the format.
std::unique_ptr<RecordedLog> open_log(const LogChoice& choice);

/// The default noise for a log of this format; nothing where the log states it.
LogNoise default_noise(LogFormat format);

/// The settings for replaying a log without settings of its own, as YAML: estimators with their options.
std::string default_settings(LogFormat format);

}  // namespace harness
