#include "harness/readers/landmark_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/files/bad_input.hpp"

namespace harness {

void sort_by_id(std::vector<TrueLandmark>& landmarks, const std::filesystem::path& file,
                std::string_view name) {
  std::ranges::sort(landmarks, {}, &TrueLandmark::landmark);
  const auto twice = std::ranges::adjacent_find(landmarks, {}, &TrueLandmark::landmark);
  if (twice != landmarks.end())
    throw BadInput(fmt::format("{}: {} {} stands there twice", file.string(), name, twice->landmark));
}

void begin_scan(ScanEvent& event, double t, const std::optional<TruePose>& truth) {
  event.scan.t = t;
  event.scan.observations.clear();
  event.true_ids.clear();
  event.truth = truth;
}

void add_once(const seif::Observation& observation, ScanEvent& event, ReadCounts& counts) {
  std::vector<seif::Observation>& seen = event.scan.observations;
  if (observation.landmark != seif::no_landmark &&
      std::ranges::find(seen, observation.landmark, &seif::Observation::landmark) != seen.end()) {
    ++counts.repeated;
  } else {
    seen.push_back(observation);
  }
}

}  // namespace harness
