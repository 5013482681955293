// Which landmark of the world each landmark of a map is, where a filter gives names of its own: that of which
// most of its observations truly were. Definitions: docs/scores.md.
#pragma once

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

class TrueNames {
 public:
  /// An observation that the filter took for `name` and that was of `true_id`; no_landmark: a false
  /// detection.
  void add(seif::LandmarkId name, seif::LandmarkId true_id) { ++counts_[name][true_id]; }
  /// Those of one scan. Observations that were left out count for nothing.
  void add(std::span<const seif::LandmarkId> names, std::span<const seif::LandmarkId> true_ids);

  /// The smaller id where as many observations were of two; no_landmark of a name that was mostly false or
  /// never given.
  seif::LandmarkId of(seif::LandmarkId name) const;
  /// Observations of a name that were of the landmark that it is. [-]
  std::int64_t right(seif::LandmarkId name) const;
  /// The same of all names. [-]
  std::int64_t right() const;

 private:
  std::map<seif::LandmarkId, std::map<seif::LandmarkId, std::int64_t>> counts_;
};

/// What a filter that names landmarks by itself made of the observations of a run.
struct Associations {
  std::int64_t named = 0;          // [-] observations that it took in
  std::int64_t left_out = 0;       // [-] the others
  std::optional<TrueNames> names;  // where the true ids are known
};

/// Reads ESTIMATOR_associations.csv; nothing for a filter whose associations are known. Throws BadInput, as
/// the next.
std::optional<Associations> read_associations(const std::filesystem::path& folder,
                                              const std::string& estimator);

/// A map whose landmarks bear the ids of the world, as far as they are known; no_landmark: of nothing.
struct ScoredMap {
  std::vector<MapRecord> landmarks;
  int duplicates = 0;  // [-] left out: of a landmark that another one is, which has more right observations
};

ScoredMap read_scored_map(const std::filesystem::path& folder, const std::string& estimator);
ScoredMap score_names(std::span<const MapRecord> map, const TrueNames& names);

}  // namespace harness
