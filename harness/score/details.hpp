// What `seifbed score` says about a run beyond its summary, from the files of its folder. Definitions:
// docs/scores.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
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
  std::vector<double> distances = {1.0, 5.0, 10.0};  // [m] of the relative pose error
  double away = 20.0;                                // [s] after which seeing a landmark again closes a loop
  /// Where ESTIMATOR_consistency.csv is; empty: in the folder of the run.
  std::filesystem::path consistency;
};

/// A score that is not available is empty.
struct EstimatorDetails {
  std::string name;
  std::vector<RelativePoseError> rpe;              // at each of the distances
  std::optional<MapCounts> map;                    // if the world's landmarks are known
  std::optional<double> landmark_rmse_from_robot;  // [m] at the end
  std::size_t poses_scored = 0;                    // [-] moments with a NEES of the pose
  std::optional<double> pose_inside;               // [-] the share of them inside the chi-square band
  std::optional<double> landmarks_inside;          // [-] share of the final map's landmarks inside theirs
  RebuiltScore rebuilt;                            // by a replay, if there was one
  std::optional<DistanceFromReference> from_reference;  // if a reference was asked for
  std::array<std::optional<double>, response_updates.size()> closure_error = {};  // [m] of the position
};

struct RunDetails {
  DetailChoices choices;
  std::string reference;      // its name; empty: none was asked for
  std::size_t closures = 0;   // [-]
  EstimatorDetails odometry;  // the trajectory alone
  std::vector<EstimatorDetails> estimators;
};

/// Throws BadInput if a file is missing or broken.
RunDetails score_details(const std::filesystem::path& folder, std::span<const std::string> estimators,
                         const DetailChoices& choices);

/// The summary, with the details in each estimator.
std::string to_json(const Summary& summary, const RunDetails& details);

/// Of the map, of what was rebuilt, of the path, and, if there is such, of the distance from a reference and
/// of the error after a loop has closed.
std::vector<std::vector<TextRow>> details_tables(const RunDetails& details);

/// The same as text.
std::string details_board(const RunDetails& details);

}  // namespace harness
