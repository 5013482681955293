#include "harness/live/live_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

// What one message holds at most.
constexpr std::size_t posts_at_once = 20'000;   // [-]
constexpr std::size_t means_at_once = 4000;     // [-] of each estimator
constexpr std::size_t ellipses_at_once = 1000;  // [-]

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json json_of(const seif::Pose2& pose) { return {pose.x, pose.y, pose.theta}; }

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

const char* word_of(LiveState state) {
  switch (state) {
    case LiveState::running:
      return "running";
    case LiveState::paused:
      return "paused";
    case LiveState::stage:
      return "stage";
    case LiveState::rewinding:
      return "rewinding";
    case LiveState::ended:
      return "ended";
  }
  return "";
}

Json status_json(const LiveSnapshot& snapshot, int viewers) {
  const LiveStatus& status = snapshot.status;
  Json json = {{"kind", "frame"},
               {"epoch", snapshot.epoch},
               {"t", snapshot.t},
               {"step", snapshot.steps},
               {"updates", snapshot.updates},
               {"state", word_of(status.state)},
               {"progress", status.progress},
               {"speed", std::isfinite(status.speed) ? Json(status.speed) : Json("max")},
               {"realtime", status.realtime},
               {"hand", status.by_hand},
               {"silent", Json::array()},
               {"odometry", json_of(snapshot.odometry)},
               {"watched", status.watched},
               {"viewers", viewers},
               {"estimators", Json::array()}};
  if (status.is_blind) json["silent"].push_back("landmark_sensor");
  if (status.is_numb) json["silent"].push_back("encoders");
  json["truth"] = nullptr;
  if (const auto& truth = snapshot.truth) {
    const seif::Pose2& pose = truth->T_world_robot;
    json["truth"] = {pose.x, pose.y, pose.theta, truth->left_wheel, truth->right_wheel};
  }
  return json;
}

Json belief_json(const LiveBelief& belief) {
  const LiveFigures& figures = belief.figures;
  Json covariance = nullptr;
  if (belief.covariance)
    covariance = std::vector<double>(belief.covariance->data(), belief.covariance->data() + 9);
  return {{"pose", json_of(belief.pose)},
          {"covariance", covariance},
          {"update_us", figures.update_us},
          {"p50_us", figures.p50_us},
          {"p99_us", figures.p99_us},
          {"nees", json_of(figures.nees)},
          {"nees_map", json_of(figures.nees_map)},
          {"error_m", json_of(figures.error)},
          {"rmse_m", json_of(figures.rmse)},
          {"three_sigma_m", json_of(figures.three_sigma)},
          {"links", figures.links},
          {"active", figures.active},
          {"landmarks", figures.landmarks},
          {"memory_bytes", figures.memory_bytes},
          {"failure", belief.failure}};
}

std::span<const float> floats_of(const std::vector<LivePoint>& points) {
  static_assert(sizeof(LivePoint) == 2 * sizeof(float));
  return {reinterpret_cast<const float*>(points.data()), 2 * points.size()};
}

std::span<const float> floats_of(const std::vector<LiveChartPoint>& points) {
  static_assert(sizeof(LiveChartPoint) == 5 * sizeof(float));
  return {reinterpret_cast<const float*>(points.data()), 5 * points.size()};
}

}  // namespace

void LiveBoard::set(std::shared_ptr<const LiveSetting> setting) {
  const bool is_anew = !setting_ || setting_->epoch != setting->epoch;
  setting_ = std::move(setting);
  if (!is_anew) return;
  snapshots_ = matrix_version_ = 0;
  matrix_ = {};
  true_trail_ = odometry_trail_ = {};
  beliefs_.clear();
  beliefs_.resize(setting_->estimators.size());
}

void LiveBoard::take(const LiveSnapshot& snapshot) {
  if (!setting_ || snapshot.epoch != setting_->epoch) return;
  ++snapshots_;
  latest_.epoch = snapshot.epoch;
  latest_.t = snapshot.t;
  latest_.steps = snapshot.steps;
  latest_.updates = snapshot.updates;
  latest_.status = snapshot.status;
  latest_.truth = snapshot.truth;
  latest_.odometry = snapshot.odometry;
  latest_.rays = snapshot.rays;
  for (const LivePoint& point : snapshot.true_trail) true_trail_.add(point);
  for (const LivePoint& point : snapshot.odometry_trail) odometry_trail_.add(point);
  if (snapshot.matrix) {
    matrix_ = *snapshot.matrix;
    ++matrix_version_;
  }
  for (std::size_t i = 0; i < std::min(beliefs_.size(), snapshot.beliefs.size()); ++i) {
    const LiveBelief& told = snapshot.beliefs[i];
    Belief& belief = beliefs_[i];
    belief.latest.pose = told.pose;
    belief.latest.covariance = told.covariance;
    belief.latest.failure = told.failure;
    belief.latest.figures = told.figures;
    belief.latest.active = told.active;
    for (const LiveMean& mean : told.means)
      belief.means.put(static_cast<std::uint32_t>(mean.landmark), {mean.p.x, mean.p.y});
    for (const LiveEllipse& ellipse : told.ellipses)
      belief.ellipses.put(static_cast<std::uint32_t>(ellipse.landmark), {ellipse.xx, ellipse.xy, ellipse.yy});
    for (const LivePoint& point : told.trail) belief.trail.add(point);
    for (const LiveChartPoint& point : told.charts) belief.charts.add(point);
    if (!told.links) continue;
    belief.links = *told.links;
    ++belief.links_version;
  }
}

bool LiveBoard::next(BoardCursor& cursor, bool wants_matrix, int viewers, PageMessage& message) {
  if (!setting_) return false;
  if (write_setting(cursor, message)) return true;
  const bool has_frame = snapshots_ > cursor.snapshot;
  // The landmarks that are near the beginning of the list come first, then the first frame: a picture at once.
  if ((!has_frame || cursor.posts == 0 || cursor.snapshot > 0) && write_posts(cursor, message)) return true;
  if (!has_frame) return false;
  if (cursor.history < 2) {
    write_history(cursor, message);
  } else if (wants_matrix && matrix_version_ > cursor.matrix) {
    write_matrix(cursor, message);
  } else {
    write_frame(cursor, viewers, message);
  }
  return true;
}

/// The description of the run and its solid things.
bool LiveBoard::write_setting(BoardCursor& cursor, PageMessage& message) {
  arrays_.clear();
  if (cursor.epoch != setting_->epoch) {
    cursor = {};
    cursor.epoch = setting_->epoch;
    cursor.version = setting_->version - 1;
    cursor.beliefs.resize(beliefs_.size());
    write_message(setting_->hello, arrays_, message);
    return true;
  }
  if (cursor.version == setting_->version) return false;
  cursor.version = setting_->version;
  arrays_.add("solids", setting_->solids);
  arrays_.add("tints", setting_->tints);
  write_message(R"({"kind":"solids"})", arrays_, message);
  return true;
}

bool LiveBoard::write_posts(BoardCursor& cursor, PageMessage& message) {
  const std::size_t total = setting_->post_ids.size();
  if (cursor.posts >= total) return false;
  const std::size_t first = cursor.posts;
  const std::size_t count = std::min(posts_at_once, total - first);
  cursor.posts += count;
  arrays_.clear();
  arrays_.add("ids", std::span(setting_->post_ids).subspan(first, count));
  arrays_.add("posts", std::span(setting_->posts).subspan(3 * first, 3 * count));
  write_message(fmt::format(R"({{"kind":"posts","first":{},"total":{}}})", first, total), arrays_, message);
  return true;
}

/// Trails and charts as a whole; later frames bring what is new.
void LiveBoard::write_history(BoardCursor& cursor, PageMessage& message) {
  arrays_.clear();
  if (cursor.history++ == 0) {
    true_trail_.collect(cursor.true_trail, points_);
    arrays_.add("truth", floats_of(points_));
    odometry_trail_.collect(cursor.odometry_trail, points_);
    arrays_.add("odometry", floats_of(points_));
    for (std::size_t i = 0; i < beliefs_.size(); ++i) {
      beliefs_[i].trail.collect(cursor.beliefs[i].trail, points_);
      arrays_.add(fmt::format("estimate{}", i), floats_of(points_));
    }
    return write_message(R"({"kind":"trails"})", arrays_, message);
  }
  for (std::size_t i = 0; i < beliefs_.size(); ++i) {
    beliefs_[i].charts.collect(cursor.beliefs[i].charts, charts_);
    arrays_.add(fmt::format("h{}", i), floats_of(charts_));
  }
  write_message(R"({"kind":"history"})", arrays_, message);
}

void LiveBoard::write_frame(BoardCursor& cursor, int viewers, PageMessage& message) {
  cursor.snapshot = snapshots_;
  Json json = status_json(latest_, viewers);
  arrays_.clear();
  floats_.clear();
  for (const LiveRay& ray : latest_.rays)
    floats_.insert(floats_.end(), {ray.end.x, ray.end.y, static_cast<float>(ray.kind)});
  arrays_.add("rays", floats_);
  // A reader that has missed a part gets the whole trail: then the page replaces what it has.
  json["whole_trails"] = Json::array();
  const auto add_trail = [&](const GrowingFeed<LivePoint>& trail, GrowingFeed<LivePoint>::Cursor& at,
                             const std::string& name) {
    if (trail.collect(at, points_)) json["whole_trails"].push_back(name);
    arrays_.add("trail_" + name, floats_of(points_));
  };
  add_trail(true_trail_, cursor.true_trail, "truth");
  add_trail(odometry_trail_, cursor.odometry_trail, "odometry");
  for (std::size_t i = 0; i < beliefs_.size(); ++i) {
    json["estimators"].push_back(belief_json(beliefs_[i].latest));
    add_trail(beliefs_[i].trail, cursor.beliefs[i].trail, fmt::format("estimate{}", i));
    add_belief(i, cursor.beliefs[i]);
  }
  write_message(text_of(json), arrays_, message);
}

void LiveBoard::add_belief(std::size_t index, BoardCursor::Belief& cursor) {
  const Belief& belief = beliefs_[index];
  ids_.clear();
  floats_.clear();
  belief.means.collect(cursor.means, means_at_once, ids_, floats_);
  arrays_.add(fmt::format("ids{}", index), ids_);
  arrays_.add(fmt::format("means{}", index), floats_);
  ids_.clear();
  floats_.clear();
  belief.ellipses.collect(cursor.ellipses, ellipses_at_once, ids_, floats_);
  arrays_.add(fmt::format("covids{}", index), ids_);
  arrays_.add(fmt::format("covs{}", index), floats_);
  ids_.clear();
  for (const seif::LandmarkId id : belief.latest.active) ids_.push_back(static_cast<std::uint32_t>(id));
  arrays_.add(fmt::format("active{}", index), ids_);
  belief.charts.collect(cursor.charts, charts_);
  arrays_.add(fmt::format("h{}", index), floats_of(charts_));
  if (cursor.links == belief.links_version) return;
  cursor.links = belief.links_version;
  ids_.clear();
  floats_.clear();
  for (const LiveLink& link : belief.links) {
    ids_.insert(ids_.end(), {static_cast<std::uint32_t>(link.from), static_cast<std::uint32_t>(link.to)});
    floats_.push_back(link.weight);
  }
  arrays_.add(fmt::format("links{}", index), ids_);
  arrays_.add(fmt::format("weights{}", index), floats_);
}

void LiveBoard::write_matrix(BoardCursor& cursor, PageMessage& message) const {
  cursor.matrix = matrix_version_;
  MessageArrays arrays;
  arrays.add("cells", matrix_.darkness);
  const Json json = {{"kind", "matrix"},
                     {"estimator", latest_.status.watched},
                     {"size", matrix_.size},
                     {"fill", matrix_.fill}};
  write_message(text_of(json), arrays, message);
}

}  // namespace harness
