// What a stage of an update does to a belief: the matrix before and after it, and a sentence with the equation.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "harness/web/page_server.hpp"
#include "seif/estimator.hpp"

namespace harness {

/// The landmarks that a picture shows at most. [-]
inline constexpr std::size_t most_shown_in_stage = 24;

/// A part of an estimator's matrix at one moment: the rows of the robot and of some landmarks; all of it if the map
/// is small.
struct BeliefPicture {
  std::unordered_map<seif::LandmarkId, std::vector<seif::Coupling>> rows;  // no_landmark: the robot
  std::vector<seif::LandmarkId>
      map;                 // all landmarks, in the order of `values`; empty if the map is not small
  Eigen::MatrixXd values;  // (3+2N x 3+2N) of a small map; empty otherwise
  seif::Pose2 pose;

  /// The strength of a block; nothing if neither of its rows is in the picture. [-]
  std::optional<double> strength(seif::LandmarkId a, seif::LandmarkId b) const;
};

/// Reads the rows of the robot, of what it is linked to, and of the landmarks in the scan.
BeliefPicture picture_of(const seif::Estimator& estimator, const seif::Scan& scan);

/// A stage that has ended.
struct StageEnd {
  std::string_view estimator;  // its name
  std::string_view type;
  seif::Stage stage = seif::Stage::motion;
  double t = 0.0;  // [s] of the scan
};

/// `{"kind":"stage",..}` for the pages.
PageMessage stage_message(const StageEnd& end, const seif::Estimator& estimator, const seif::Scan& scan,
                          const BeliefPicture& before, const BeliefPicture& after);

/// What a stage did.
struct StageFacts {
  int added = 0, removed = 0, changed = 0;  // [-] blocks off the diagonal
  int seen = 0, fresh = 0;                  // [-] landmarks in the scan; those of them that are new
  double moved = 0.0, turned_deg = 0.0;     // [m] [deg] of the estimate
};

struct StageWords {
  std::string sentence;
  std::string equation;
};

/// Equations are those of the 2002 report, where the stage has one there.
StageWords words_for(seif::Stage stage, std::string_view type, seif::BeliefMatrix matrix,
                     const StageFacts& facts);

}  // namespace harness
