#include "harness/film/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "harness/files/bad_input.hpp"
#include "harness/film/paint.hpp"
#include "harness/film/titles.hpp"

namespace harness {

namespace {

using Eigen::Vector2d;

constexpr double same_time = 1e-9;      // [s] times this close are the same
constexpr double longest = 40.0;        // [s] film time, if no speed is given
constexpr double most_frames = 1e7;     // [-] of a film; drawing them takes days
constexpr double past_notes = 60.0;     // [-] updates of the charts before the first frame
constexpr double farthest_view = 12.0;  // [-] in units of the radius of interest around the robot

double between(double from, double to, double share) { return from + share * (to - from); }

seif::Pose2 share_of(const seif::Pose2& increment, double share) {
  return {share * increment.x, share * increment.y, share * increment.theta};
}

TruePose between(const TruePose& from, const TruePose& to, double share) {
  const seif::Pose2& a = from.T_world_robot;
  const seif::Pose2& b = to.T_world_robot;
  const double turn = seif::wrap_angle(b.theta - a.theta);
  return {between(from.t, to.t, share),
          {between(a.x, b.x, share), between(a.y, b.y, share), seif::wrap_angle(a.theta + share * turn)},
          between(from.left_wheel, to.left_wheel, share),
          between(from.right_wheel, to.right_wheel, share)};
}

CameraBrief brief_of(const worlds::Film& film, const Stage& stage, const Frame& view) {
  constexpr double nearest = 8.0;  // [m] if the camera were closer, the robot would hide what it sees
  return {film.camera, stage.subject(), std::max(nearest, stage.reach()), view.width / view.height,
          film.eye,    film.target};
}

Rgb colour_of(const worlds::World& world, const std::string& name) {
  const auto choice = std::ranges::find(world.estimators, name, &worlds::EstimatorChoice::name);
  return colour_of_estimator(choice == world.estimators.end() ? name : choice->type);
}

std::vector<std::size_t> indices_of(const std::vector<std::string>& names, const Believers& believers) {
  std::vector<std::size_t> indices;
  for (const std::string& name : names) {
    const auto it = std::ranges::find(believers.estimators, name, &LiveEstimator::name);
    if (it == believers.estimators.end())
      throw BadInput(fmt::format("there is no estimator '{}' to film", name));
    indices.push_back(static_cast<std::size_t>(it - believers.estimators.begin()));
  }
  return indices;
}

/// Which of these estimators keep a matrix.
std::vector<bool> matrices_of(const std::vector<std::size_t>& filmed, const Believers& believers) {
  std::vector<bool> keeps;
  for (const std::size_t i : filmed)
    keeps.push_back(believers.estimators[i].filter->belief_matrix() != seif::BeliefMatrix::none);
  return keeps;
}

void append_trail(const Trail& trail, const Vector2d& head, const render::Colour& colour, float width,
                  render::Marks& marks) {
  trail.for_each_leg(head, [&](const Vector2d& from, const Vector2d& to) {
    marks.strokes.push_back({{from.x(), from.y(), 0.02}, {to.x(), to.y(), 0.02}, width, colour});
  });
}

void clear(render::Things& things) {
  things.solids.clear();
  things.posts.clear();
  for (render::Marks* marks : {&things.marks, &things.marks_on_top}) {
    marks->ellipses.clear();
    marks->strokes.clear();
    marks->dots.clear();
  }
}

}  // namespace

std::vector<std::string> filmed_estimators(const worlds::World& world) {
  if (!world.film.estimators.empty()) return world.film.estimators;
  const auto runs = [&](const std::string& name) {
    return std::ranges::find(world.estimators, name, &worlds::EstimatorChoice::name) !=
           world.estimators.end();
  };
  std::vector<std::string> names;
  for (const std::string name : {"seif", "ekf"}) {
    if (runs(name)) names.push_back(name);
  }
  for (const worlds::EstimatorChoice& choice : world.estimators) {
    if (names.size() < 2 && std::ranges::find(names, choice.name) == names.end())
      names.push_back(choice.name);
  }
  return names;
}

FilmClock film_clock(const worlds::Film& film, double start, double end, std::optional<double> from,
                     std::optional<double> to) {
  FilmClock clock;
  clock.start = start + from.value_or(0.0);
  clock.end = std::min(end, start + to.value_or(end - start));
  clock.fps = film.fps;
  // Written so that a time that is no number fails too.
  if (!(clock.start >= start && clock.start <= end + same_time && clock.end >= clock.start - same_time))
    throw BadInput(fmt::format("there is nothing to film from {:g} s to {:g} s: the run takes {:g} s",
                               from.value_or(0.0), to.value_or(end - start), end - start));
  clock.speed = film.speed > 0.0 ? film.speed : speed_for(clock.end - clock.start, longest);
  const double frames = (clock.end - clock.start) * clock.fps / clock.speed;
  if (frames > most_frames)
    throw BadInput(
        fmt::format("a film of {:g} s at the speed {:g} has {:.3g} frames, and at most {:g} can be "
                    "drawn: choose a higher speed",
                    clock.end - clock.start, clock.speed, frames, most_frames));
  return clock;
}

FilmPlan film_plan(const worlds::World& world) {
  return {world,
          true,
          world.name,
          world.seed,
          0.0,
          world.duration,
          film_clock(world.film, 0.0, world.duration, {}, {}),
          {}};
}

Film::Film(FilmPlan plan, const LogDescription& log, const Believers& believers,
           std::unique_ptr<FrameSink> sink)
    : plan_(std::move(plan)),
      believers_(believers),
      sink_(std::move(sink)),
      renderer_(plan_.world.film.width, plan_.world.film.height),
      filmed_(indices_of(filmed_estimators(plan_.world), believers)),
      layout_(layout_of(plan_.world.film, matrices_of(filmed_, believers))),
      stage_(plan_.world, plan_.knows_world, log, plan_.path),
      sight_(plan_.world, plan_.knows_world, log.T_robot_sensor),
      camera_man_(brief_of(plan_.world.film, stage_, layout_.views.front())),
      true_trail_(trail_spacing),
      odometry_trail_(trail_spacing),
      t_(log.start_t),
      truth_(log.true_start),
      past_{plan_.start, plan_.clock.start,
            std::max((plan_.clock.start - plan_.start) / past_notes, same_time), 1} {
  const int bins = std::max(2, static_cast<int>(layout_.times.value_or(Frame{0, 0, 400, 0}).width / 2.0F));
  for (const std::size_t i : filmed_) {
    const LiveEstimator& estimator = believers.estimators[i];
    views_.emplace_back(estimator, colour_of(plan_.world, estimator.name), plan_.start, plan_.end, bins);
  }
  std::vector<Shown> shown;
  for (const BeliefView& view : views_)
    shown.push_back({view.name(), view.colour(), view.kind() == seif::BeliefMatrix::information});
  legend_ = legend_entries(plan_.world.film.layers, legend_facts(plan_.world, plan_.knows_world, log), shown);
  scene_.views.resize(layout_.views.size());
  scene_.shadows = plan_.world.film.layers.shadows;
  scene_.ground = stage_.ground(plan_.world.film.layers.grid);
}

void Film::odometry(const OdometryEvent& event) {
  advance_to(event.odometry.t, event.truth, event.odometry.T_previous_current);
}

void Film::scan(const ScanEvent& event) {
  advance_to(event.scan.t, event.truth, {});
  sight_.scan(event, best_pose({}), stage_);
  for (BeliefView& view : views_) view.scan(event);
}

void Film::dead_reckoning(double /*t*/, const seif::Pose2& T_world_robot) {
  odometry_trail_.add({T_world_robot.x, T_world_robot.y});
}

void Film::update(std::size_t estimator, const UpdateRecord& record) {
  for (std::size_t i = 0; i < filmed_.size(); ++i) {
    if (filmed_[i] == estimator) views_[i].update(record);
  }
}

/// Updates the charts for the time before the first frame.
void Film::note_past(double t) {
  while (next_note_ < past_.frames() && past_.time_of(next_note_) < t - same_time) {
    ++next_note_;
    for (BeliefView& view : views_) view.refresh(plan_.world.film.layers);
  }
}

/// Draws the frames before an event. A frame at the event's own time is drawn after the event.
void Film::advance_to(double t, const std::optional<TruePose>& truth, const seif::Pose2& increment) {
  note_past(t);
  while (!is_over() && plan_.clock.time_of(next_frame_) < t - same_time) {
    const double frame_t = plan_.clock.time_of(next_frame_);
    const double share = std::clamp((frame_t - t_) / (t - t_), 0.0, 1.0);
    now_ = truth_ && truth ? between(*truth_, *truth, share) : truth_;
    draw_frame(frame_t, share_of(increment, share));
  }
  t_ = t;
  truth_ = truth;
  now_ = truth;
  if (truth) true_trail_.add({truth->T_world_robot.x, truth->T_world_robot.y});
}

void Film::draw_frame(double t, const seif::Pose2& T_since) {
  try {
    compose(t, T_since);
    renderer_.draw(scene_, image_);
    sink_->write(image_);
    ++next_frame_;
    is_cut_ = goes_on_ && !goes_on_();
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
}

void Film::finish(bool has_ended) {
  now_ = truth_;
  while (has_ended && !is_over()) draw_frame(plan_.clock.time_of(next_frame_), {});
  if (!failure_.empty()) throw std::runtime_error(failure_);
  if (frames_drawn() > 0) sink_->finish();  // a film without a frame takes no other's place
}

/// The best known pose: the truth, otherwise the first estimator's pose, otherwise that of odometry.
seif::Pose2 Film::best_pose(const seif::Pose2& T_since) const {
  if (now_) return now_->T_world_robot;
  if (!filmed_.empty() && views_.front().failure().empty())
    return believers_.estimators[filmed_.front()].filter->pose() * T_since;
  return believers_.dead_reckoning * T_since;
}

Gaze Film::gaze_of(const render::Camera& camera, const seif::Pose2& robot) const {
  constexpr double full_size = 12.0;  // [px/m] landmark marks have full size above this scale ...
  constexpr double smallest =
      0.4;  // [-] ... and at least this share of it below: the marks of a whole map must not cover the map
  constexpr double dot = 2.6;      // [px] radius
  constexpr double nearest = 3.0;  // [-] things near the camera may look this much larger than at the target
  const Frame& view = layout_.views.front();
  const Frustum frustum(camera, view.width / view.height);
  const bool is_whole = plan_.world.film.camera == worlds::FilmCamera::overview ||
                        plan_.world.film.camera == worlds::FilmCamera::fixed;
  const double seen = camera.height > 0.0 ? camera.height
                                          : 2.0 * std::tan(0.5 * camera.field_of_view) *
                                                (camera.eye - camera.target).norm();  // [m]
  const double pixels_per_metre = view.height / seen / layout_.scale;
  const double share = std::clamp(pixels_per_metre / full_size, smallest, 1.0);
  constexpr double shortest_robot = 18.0;  // [px]
  const double robot_length = stage_.robot_length() * view.height / layout_.scale *
                              frustum.image_heights_per_metre({robot.x, robot.y, 0.0});  // [px]
  return {frustum,
          frustum.ground(is_whole ? 1e6 : farthest_view * stage_.reach()),
          layout_.scale,
          layout_.scale * static_cast<float>(share),
          std::max(1.0, shortest_robot / robot_length),
          dot * share / (nearest * pixels_per_metre)};
}

void Film::compose(double t, const seif::Pose2& T_since) {
  const worlds::FilmLayers& layers = plan_.world.film.layers;
  stage_.let_appear(t);
  const seif::Pose2 robot = best_pose(T_since);
  const render::Camera camera = camera_man_.camera(robot, next_frame_ == 0 ? 0.0 : 1.0 / plan_.clock.fps);
  const Gaze gaze = gaze_of(camera, robot);
  compose_things(gaze, T_since);
  const std::optional<seif::Pose2> true_pose = now_ ? std::optional(now_->T_world_robot) : std::nullopt;
  for (std::size_t i = 0; i < layout_.views.size(); ++i) {
    render::View& view = scene_.views[i];
    const Frame& frame = layout_.views[i];
    view.x = static_cast<int>(frame.x);
    view.y = static_cast<int>(frame.y);
    view.width = static_cast<int>(frame.width);
    view.height = static_cast<int>(frame.height);
    view.camera = camera;
    clear(view.things);
    if (i >= views_.size()) continue;
    views_[i].look(gaze, T_since, layers);
    views_[i].append(gaze, layers, stage_, true_pose, view.things);
  }
  compose_overlay(t);
}

void Film::compose_things(const Gaze& gaze, const seif::Pose2& T_since) {
  const worlds::FilmLayers& layers = plan_.world.film.layers;
  clear(scene_.things);
  stage_.append_surroundings(gaze.frustum, gaze.area, scene_.things);
  const seif::Pose2 pose = best_pose(T_since);
  stage_.append_robot(now_.value_or(TruePose{0.0, pose, 0.0, 0.0}), gaze.robot_size, scene_.things);
  if (layers.range) sight_.append_range(pose, gaze.scale, scene_.things);
  if (layers.rays) sight_.append_rays(pose, stage_.sensor_height(), gaze.scale, scene_.things);
  const seif::Pose2 reckoned = believers_.dead_reckoning * T_since;
  if (layers.odometry)
    append_trail(odometry_trail_, {reckoned.x, reckoned.y}, paint(palette::odometry), 1.8F * gaze.scale,
                 scene_.things.marks);
  if (layers.truth && now_)
    append_trail(true_trail_, {pose.x, pose.y}, paint(palette::truth), 1.8F * gaze.scale,
                 scene_.things.marks);
}

std::string Film::facts_at(double t) const {
  std::string facts = fmt::format("{:.1f} s", t - plan_.start);
  if (plan_.clock.frames() > 1) facts += fmt::format("    ×{:g}", plan_.clock.speed);
  return facts + fmt::format("    seed {}", plan_.seed);
}

void Film::compose_overlay(double t) {
  const worlds::FilmLayers& layers = plan_.world.film.layers;
  std::vector<render::OverlayItem>& overlay = scene_.overlay;
  overlay.clear();
  append_panel(layout_, overlay);
  const float scale = layout_.scale;
  if (layout_.caption)
    append_caption(*layout_.caption, scale,
                   {plan_.name, plan_.knows_world ? plan_.world.description : "", facts_at(t)}, overlay);
  for (std::size_t i = 0; layers.caption && i < views_.size(); ++i)
    append_view_title(layout_.views[i], scale, views_[i], overlay);
  for (std::size_t i = 0; i < layout_.matrices.size(); ++i) {
    if (layout_.matrices[i]) append_matrix(*layout_.matrices[i], scale, views_[i], overlay);
  }
  if (layout_.times) {
    Chart chart{*layout_.times, "time of an update", "µs", 0, Scale::logarithmic, {}};
    for (const BeliefView& view : views_)
      chart.curves.push_back({view.name(), view.colour(), &view.update_times(), nullptr});
    append_chart(chart, scale, overlay);
  }
  if (layout_.pose_error) {
    Chart chart{*layout_.pose_error, "position error, 3σ", "m", 3, Scale::linear, {}};
    for (const BeliefView& view : views_)
      chart.curves.push_back({view.name(), view.colour(), &view.position_errors(), &view.three_sigma()});
    append_chart(chart, scale, overlay);
  }
  if (layout_.legend) append_legend(*layout_.legend, scale, legend_, overlay);
}

}  // namespace harness
