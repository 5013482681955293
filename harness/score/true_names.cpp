#include "harness/score/true_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "harness/files/csv_reader.hpp"
#include "harness/score/score_folder.hpp"

namespace harness {

namespace {

seif::LandmarkId id_in(const CsvReader& rows, int column) {
  if (rows.is_empty(column)) return seif::no_landmark;
  return static_cast<seif::LandmarkId>(rows.integer(column, 0, std::numeric_limits<seif::LandmarkId>::max()));
}

}  // namespace

void TrueNames::add(std::span<const seif::LandmarkId> names, std::span<const seif::LandmarkId> true_ids) {
  for (std::size_t i = 0; i < std::min(names.size(), true_ids.size()); ++i) {
    if (names[i] != seif::no_landmark) add(names[i], true_ids[i]);
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
    constexpr int range_column = 2;
    if (observations.is_empty(range_column)) continue;
    const seif::LandmarkId name = id_in(names, 1);
    ++(name == seif::no_landmark ? associations.left_out : associations.named);
    if (true_ids && name != seif::no_landmark) associations.names->add(name, id_in(*true_ids, 1));
  }
  return associations;
}

ScoredMap score_names(std::span<const MapRecord> map, const TrueNames& names) {
  std::map<seif::LandmarkId, const MapRecord*> best;  // by true id
  ScoredMap scored;
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

ScoredMap read_scored_map(const std::filesystem::path& folder, const std::string& estimator) {
  const std::vector<MapRecord> map = read_map(folder, estimator);
  const std::optional<Associations> associations = read_associations(folder, estimator);
  if (!associations || !associations->names) return {map, 0};
  return score_names(map, *associations->names);
}

}  // namespace harness
