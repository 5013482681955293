#include "harness/live/stage_show.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>

#include "harness/live/message.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

constexpr double visible_change = 0.01;  // [-] relative

const char* name_of(seif::Stage stage) {
  switch (stage) {
    case seif::Stage::motion:
      return "motion";
    case seif::Stage::measurement:
      return "measurement";
    case seif::Stage::sparsification:
      return "sparsification";
    case seif::Stage::mean_recovery:
      break;
  }
  return "mean_recovery";
}

/// The landmarks of both pictures that matter most to this stage: those seen, then those that the robot is linked to
/// before or after, the strongest links first.
std::vector<seif::LandmarkId> chosen(const seif::Scan& scan, const BeliefPicture& before,
                                     const BeliefPicture& after) {
  if (!after.map.empty()) return after.map;
  std::set<seif::LandmarkId> ids;
  for (const seif::Observation& z : scan.observations) {
    if (after.rows.contains(z.landmark) && ids.size() < most_shown_in_stage) ids.insert(z.landmark);
  }
  for (const BeliefPicture* picture : {&before, &after}) {
    std::vector<seif::Coupling> links = picture->rows.at(seif::no_landmark);
    std::ranges::sort(links, std::ranges::greater{}, &seif::Coupling::strength);
    for (const seif::Coupling& link : links) {
      if (ids.size() < most_shown_in_stage) ids.insert(link.other);
    }
  }
  return {ids.begin(), ids.end()};
}

/// ((k+1) x (k+1)) strengths; row 0 is the robot. Blocks that a picture does not have are those of the other one.
std::vector<float> strengths_of(const std::vector<seif::LandmarkId>& ids, const BeliefPicture& picture,
                                const BeliefPicture& other) {
  std::vector<seif::LandmarkId> all = {seif::no_landmark};
  all.insert(all.end(), ids.begin(), ids.end());
  std::vector<float> strengths;
  for (const seif::LandmarkId a : all) {
    for (const seif::LandmarkId b : all) {
      const std::optional<double> own = picture.strength(a, b);
      strengths.push_back(
          static_cast<float>(a == b ? 1.0 : own.value_or(other.strength(a, b).value_or(0.0))));
    }
  }
  return strengths;
}

std::vector<float> floats_of(const Eigen::MatrixXd& values) {
  const Eigen::MatrixXf floats = values.cast<float>();
  return {floats.data(), floats.data() + floats.size()};
}

/// The matrix of a smaller map in the order of a larger one, with zeros for what it does not have.
Eigen::MatrixXd padded(const Eigen::MatrixXd& values, Eigen::Index size) {
  Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(size, size);
  larger.topLeftCorner(values.rows(), values.cols()) = values;
  return larger;
}

StageFacts facts_of(const std::vector<float>& before, const std::vector<float>& after, std::size_t rows) {
  StageFacts facts;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const float was = before[i * rows + j];
      const float is = after[i * rows + j];
      if (was == 0.0F && is > 0.0F) ++facts.added;
      if (was > 0.0F && is == 0.0F) ++facts.removed;
      if (was > 0.0F && is > 0.0F && std::abs(is - was) > visible_change * was) ++facts.changed;
    }
  }
  return facts;
}

}  // namespace

std::optional<double> BeliefPicture::strength(seif::LandmarkId a, seif::LandmarkId b) const {
  for (const auto& [row, column] : {std::pair(a, b), std::pair(b, a)}) {
    const auto found = rows.find(row);
    if (found == rows.end()) continue;
    const auto coupling = std::ranges::find(found->second, column, &seif::Coupling::other);
    return coupling == found->second.end() ? 0.0 : coupling->strength;
  }
  return std::nullopt;
}

BeliefPicture picture_of(const seif::Estimator& estimator, const seif::Scan& scan) {
  constexpr std::size_t most_rows = 200;  // [-]
  BeliefPicture picture;
  picture.pose = estimator.pose();
  std::vector<seif::LandmarkId> wanted;
  std::vector<seif::Coupling>& robot = picture.rows[seif::no_landmark];
  estimator.couplings(seif::no_landmark, robot);
  for (const seif::Coupling& link : robot) wanted.push_back(link.other);
  for (const seif::Observation& z : scan.observations) wanted.push_back(z.landmark);
  std::vector<seif::LandmarkEstimate> known;
  estimator.landmarks(wanted, known);
  // A small map is shown as a whole. The memory says whether map() is worth a try.
  constexpr std::size_t memory_of_small_map = 1'000'000;  // [byte] or more
  if (estimator.memory_bytes() < memory_of_small_map) {
    const std::vector<seif::LandmarkEstimate> map = estimator.map();
    if (map.size() <= most_shown_in_stage) {
      known = map;
      for (const seif::LandmarkEstimate& landmark : map) picture.map.push_back(landmark.landmark);
      picture.values = estimator.whole_belief_matrix();
    }
  }
  for (const seif::LandmarkEstimate& landmark : known) {
    if (picture.rows.size() <= most_rows)
      estimator.couplings(landmark.landmark, picture.rows[landmark.landmark]);
  }
  return picture;
}

PageMessage stage_message(const StageEnd& end, const seif::Estimator& estimator, const seif::Scan& scan,
                          const BeliefPicture& before, const BeliefPicture& after) {
  const std::vector<seif::LandmarkId> ids = chosen(scan, before, after);
  const std::size_t rows = ids.size() + 1;
  const std::vector<float> was = strengths_of(ids, before, after);
  const std::vector<float> is = strengths_of(ids, after, before);
  StageFacts facts = facts_of(was, is, rows);
  facts.seen = static_cast<int>(scan.observations.size());
  facts.fresh = static_cast<int>(std::ranges::count_if(
      scan.observations, [&](const seif::Observation& z) { return !before.rows.contains(z.landmark); }));
  facts.moved = std::hypot(after.pose.x - before.pose.x, after.pose.y - before.pose.y);
  facts.turned_deg = seif::wrap_angle(after.pose.theta - before.pose.theta) * 180.0 / std::numbers::pi;
  const StageWords words = words_for(end.stage, end.type, estimator.belief_matrix(), facts);

  const bool is_whole = after.values.size() > 0 && !after.map.empty();
  MessageArrays arrays;
  arrays.add("before", was);
  arrays.add("after", is);
  if (is_whole) {
    arrays.add("values_before", floats_of(padded(before.values, after.values.rows())));
    arrays.add("values_after", floats_of(after.values));
  }
  const Json json = {{"kind", "stage"},
                     {"estimator", end.estimator},
                     {"t", end.t},
                     {"stage", name_of(end.stage)},
                     {"number", static_cast<int>(end.stage) + 1},
                     {"of", 4},
                     {"sentence", words.sentence},
                     {"equation", words.equation},
                     {"added", facts.added},
                     {"removed", facts.removed},
                     {"changed", facts.changed},
                     {"ids", ids},
                     {"whole", is_whole}};
  PageMessage message;
  write_message(json.dump(-1, ' ', false, Json::error_handler_t::replace), arrays, message);
  return message;
}

}  // namespace harness
