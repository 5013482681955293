// Says which of the world's landmarks each scan of a log saw.
#pragma once

#include <filesystem>
#include <optional>
#include <set>

#include "harness/score/landmark_places.hpp"
#include "harness/score/loop_closure.hpp"
#include "harness/stream/log_description.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

/// By the recorded true ids, or else by the names that the observations bear. Observations without names are
/// placed from the true pose, if it is known: they saw the landmark that lies there.
class SeenLandmarks {
 public:
  /// Keeps a reference.
  explicit SeenLandmarks(const LogDescription& log);

  SeenScan of(const ScanEvent& event);

  /// False if neither names nor places were known for any observation so far.
  bool is_known() const { return is_known_; }

 private:
  seif::LandmarkId by_place(const seif::Observation& observation, const seif::Pose2& T_world_robot);

  const LogDescription& log_;
  std::optional<LandmarkPlaces> places_;  // made when it is first needed
  double radius_ = 0.0;                   // [m] no landmark is looked for farther away
  bool is_known_ = false;
};

/// The ids of the world's landmarks that any scan of a log saw; empty if that is not known. Throws BadInput.
std::optional<std::set<seif::LandmarkId>> read_seen_landmarks(const std::filesystem::path& folder);

}  // namespace harness
