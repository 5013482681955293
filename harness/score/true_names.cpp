#include "harness/score/true_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "harness/files/csv_reader.hpp"
#include "harness/score/place_matching.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/statistics/alignment.hpp"
#include "harness/stream/log_stream.hpp"

namespace harness {

namespace {

// Columns of observations.csv.
constexpr int name_column = 1;
constexpr int range_column = 2;

seif::LandmarkId id_in(const CsvReader& rows, int column) {
  if (rows.is_empty(column)) return seif::no_landmark;
  return static_cast<seif::LandmarkId>(rows.integer(column, 0, std::numeric_limits<seif::LandmarkId>::max()));
}

}  // namespace

std::optional<seif::LandmarkId> true_id(const ScanEvent& event, std::size_t i) {
  if (!event.true_ids.empty()) return event.true_ids.at(i);
  const seif::LandmarkId name = event.scan.observations.at(i).landmark;
  return name == seif::no_landmark ? std::nullopt : std::optional(name);
}

void TrueNames::add(std::span<const seif::LandmarkId> names, const ScanEvent& event) {
  for (std::size_t i = 0; i < std::min(names.size(), event.scan.observations.size()); ++i) {
    if (names[i] == seif::no_landmark) continue;
    if (const std::optional<seif::LandmarkId> id = true_id(event, i)) add(names[i], *id);
  }
}

seif::LandmarkId TrueNames::of(seif::LandmarkId name) const {
  const auto found = counts_.find(name);
  if (found == counts_.end()) return seif::no_landmark;
  return std::ranges::max_element(found->second, {}, [](const auto& count) { return count.second; })->first;
}

std::int64_t TrueNames::right(seif::LandmarkId name) const {
  const seif::LandmarkId landmark = of(name);
  return landmark == seif::no_landmark ? 0 : counts_.at(name).at(landmark);
}

std::int64_t TrueNames::right() const {
  std::int64_t sum = 0;
  for (const auto& [name, counts] : counts_) sum += right(name);
  return sum;
}

std::optional<Associations> read_associations(const std::filesystem::path& folder,
                                              const std::string& estimator) {
  const std::filesystem::path file = folder / (estimator + "_associations.csv");
  if (!std::filesystem::exists(file)) return std::nullopt;
  CsvReader names(file, {{"t", "landmark"}, {}});
  CsvReader observations(folder / "observations.csv",
                         {{"t", "landmark", "range", "bearing"}, {"cov_rr", "cov_rb", "cov_bb"}});
  std::optional<CsvReader> true_ids;
  Associations associations;
  if (std::filesystem::exists(folder / "observations_true_ids.csv")) {
    true_ids.emplace(folder / "observations_true_ids.csv", Columns{{"t", "true_landmark"}, {}});
    associations.names.emplace();
  }
  while (names.next()) {  // a filter that failed has fewer rows
    if (!observations.next() || (true_ids && !true_ids->next()))
      names.fail(0, "observations.csv, or the file of the true ids, has no row for this one");
    if (observations.is_empty(range_column)) continue;
    const seif::LandmarkId name = id_in(names, 1);
    ++(name == seif::no_landmark ? associations.left_out : associations.named);
    const bool bears_name = !observations.is_empty(name_column);
    if (!true_ids && !bears_name) continue;
    if (!associations.names) associations.names.emplace();
    if (name == seif::no_landmark) continue;
    associations.names->add(name, true_ids ? id_in(*true_ids, 1) : id_in(observations, name_column));
  }
  return associations;
}

ScoredMap score_names(std::span<const MapRecord> map, const TrueNames& names) {
  std::map<seif::LandmarkId, const MapRecord*> best;  // by true id
  ScoredMap scored;
  scored.matched_by = MatchedBy::vote;
  for (const MapRecord& landmark : map) {
    const seif::LandmarkId id = names.of(landmark.landmark);
    if (id == seif::no_landmark) continue;
    const auto [place, is_first] = best.try_emplace(id, &landmark);
    if (is_first) continue;
    ++scored.duplicates;
    if (names.right(landmark.landmark) > names.right(place->second->landmark)) place->second = &landmark;
  }
  for (const MapRecord& landmark : map) {
    const seif::LandmarkId id = names.of(landmark.landmark);
    if (id != seif::no_landmark && best.at(id) != &landmark) continue;
    scored.landmarks.push_back(landmark);
    scored.landmarks.back().landmark = id;
  }
  return scored;
}

namespace {

/// All ids are replaced.
ScoredMap score_places(std::vector<MapRecord> map, const std::filesystem::path& folder,
                       const std::string& estimator) {
  std::optional<std::vector<seif::LandmarkId>> ids;
  if (std::filesystem::exists(folder / "landmarks.csv")) {
    std::vector<Eigen::Vector2d> est_path;
    std::vector<Eigen::Vector2d> true_path;
    for (const PosePair& pair : read_poses(folder, estimator)) {
      est_path.emplace_back(pair.est_pose.x, pair.est_pose.y);
      true_path.emplace_back(pair.true_pose.x, pair.true_pose.y);
    }
    ids = match_by_place(map, read_landmarks(folder / "landmarks.csv"), align(est_path, true_path));
  }
  for (std::size_t i = 0; i < map.size(); ++i) map[i].landmark = ids ? ids->at(i) : seif::no_landmark;
  return {std::move(map), 0, ids ? MatchedBy::place : MatchedBy::nothing};
}

}  // namespace

ScoredMap read_scored_map(const std::filesystem::path& folder, const std::string& estimator) {
  std::vector<MapRecord> map = read_map(folder, estimator);
  const std::optional<Associations> associations = read_associations(folder, estimator);
  if (!associations) return {std::move(map)};
  if (!associations->names) return score_places(std::move(map), folder, estimator);
  return score_names(map, *associations->names);
}

}  // namespace harness
