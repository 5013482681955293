// The details that `seifbed score` adds to the summary of a run. They come from the files of the run's
// folder. Definitions: docs/scores.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/files/text_table.hpp"
#include "harness/score/from_reference.hpp"
#include "harness/score/loop_closure.hpp"
#include "harness/score/map_counts.hpp"
#include "harness/score/rebuilt.hpp"
#include "harness/score/score.hpp"
#include "harness/score/summary.hpp"

namespace harness {

struct DetailChoices {
  std::vector<double> distances = {1.0, 5.0, 10.0};  // [m] path lengths of the relative pose error
  double away = 20.0;                                // [s] a landmark unseen for this long closes a loop
  /// The folder of `ESTIMATOR_consistency.csv`; empty: the run's own folder.
  std::filesystem::path consistency;
};

/// A value that is not available is empty.
struct EstimatorDetails {
  std::string name;
  std::vector<RelativePoseError> rpe;              // one for each of `distances`
  std::optional<MapCounts> map;                    // if the world's landmarks are known
  std::optional<double> landmark_rmse_from_robot;  // [m] when the run ends
  std::size_t poses_scored = 0;                    // [-] times at which the pose has a NEES
  std::optional<double> pose_inside;               // [-] share of these times inside the chi-square band
  std::optional<double> landmarks_inside;          // [-] share of the final map's landmarks inside theirs
  RebuiltScore rebuilt;                            // from a replay, if there was one
  std::optional<DistanceFromReference> from_reference;  // if the user asked for a reference
  std::array<std::optional<double>, response_updates.size()> closure_error = {};  // [m] error of the position
};

struct RunDetails {
  DetailChoices choices;
  std::string reference;  // name of the reference; empty: there is none
  std::vector<std::pair<std::string, std::string>> missing_references = {};  // name, and why it is missing
  std::size_t closures = 0;                                                  // [-]
  EstimatorDetails odometry;                                                 // its trajectory only
  std::vector<EstimatorDetails> estimators;
};

/// Scores the named estimators of a run. Throws BadInput if a file is missing or broken.
RunDetails score_details(const std::filesystem::path& folder, std::span<const std::string> estimators,
                         const DetailChoices& choices);

/// The summary as JSON, with the details added to each estimator.
std::string to_json(const Summary& summary, const RunDetails& details);

/// The tables, in this order: the map, the rebuilt scores, the path; then the error after a loop closure and
/// the distance from the reference, if there are any.
std::vector<std::vector<TextRow>> details_tables(const RunDetails& details);

/// The same tables as text.
std::string details_board(const RunDetails& details);

}  // namespace harness
