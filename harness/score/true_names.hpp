// For filters that give landmarks names of their own: finds the world's landmark behind each name. That is
// the landmark that most of the name's observations truly saw. Definitions: docs/scores.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/stream/run_listener.hpp"
#include "seif/types.hpp"

namespace harness {

/// The world's landmark behind observation `i` of a scan: the recorded true id, or else the name that the
/// observation bears. no_landmark: a false detection. Empty if neither is known.
std::optional<seif::LandmarkId> true_id(const ScanEvent& event, std::size_t i);

class TrueNames {
 public:
  /// Counts one observation that the filter took for `name` and that truly saw `true_id` (no_landmark: a
  /// false detection).
  void add(seif::LandmarkId name, seif::LandmarkId true_id) { ++counts_[name][true_id]; }
  /// Counts the observations of one scan, to which the filter gave `names`. An observation does not count if
  /// the filter left it out, or if its true landmark is not known.
  void add(std::span<const seif::LandmarkId> names, const ScanEvent& event);

  /// The world's landmark behind a name. If two landmarks have the same count, it is the one with the smaller
  /// id. no_landmark if most observations of the name were false detections, or if the name was never given.
  seif::LandmarkId of(seif::LandmarkId name) const;
  /// Observations of `name` that saw the landmark behind it. [-]
  std::int64_t right(seif::LandmarkId name) const;
  /// The sum of these over all names. [-]
  std::int64_t right() const;

 private:
  std::map<seif::LandmarkId, std::map<seif::LandmarkId, std::int64_t>> counts_;
};

/// How a filter that names landmarks by itself treated the observations of a run.
struct Associations {
  std::int64_t named = 0;          // [-] observations that it gave a name
  std::int64_t left_out = 0;       // [-] observations without a name
  std::optional<TrueNames> names;  // if the true ids are recorded, or the observations bear names
};

/// Reads `ESTIMATOR_associations.csv`. Empty if the filter is told the ids. Throws BadInput, as does
/// read_scored_map().
std::optional<Associations> read_associations(const std::filesystem::path& folder,
                                              const std::string& estimator);

/// How the world's landmark behind each landmark of a map was found.
enum class MatchedBy { id, vote, place, nothing };

/// A map with the ids of the world where they are known. An id is no_landmark if the world has no such
/// landmark.
struct ScoredMap {
  std::vector<MapRecord> landmarks;
  int duplicates = 0;  // [-] left out: another one with more right observations is the same landmark
  MatchedBy matched_by = MatchedBy::id;  // nothing: all ids are no_landmark
};

/// Names that the filter made by itself are replaced by a vote, or else by place (match_by_place()).
ScoredMap read_scored_map(const std::filesystem::path& folder, const std::string& estimator);
ScoredMap score_names(std::span<const MapRecord> map, const TrueNames& names);

}  // namespace harness
