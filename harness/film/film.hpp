// Films a run: follows the run's events and draws the frames.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/film/belief_view.hpp"
#include "harness/film/camera_man.hpp"
#include "harness/film/film_clock.hpp"
#include "harness/film/frame_sink.hpp"
#include "harness/film/layout.hpp"
#include "harness/film/legend.hpp"
#include "harness/film/sight.hpp"
#include "harness/film/stage.hpp"
#include "harness/film/trail.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/stream/run_listener.hpp"
#include "sim/render/renderer.hpp"
#include "worlds/world.hpp"

namespace harness {

/// What is filmed, and how.
struct FilmPlan {
  worlds::World world;      // of the run; `world.film` says how
  bool knows_world = true;  // false: the log has no world file, and only `world.film` is used
  std::string name;         // name of the world or log
  std::uint64_t seed = 0;
  double start = 0.0;  // [s] simulated time at which the charts begin
  double end = 0.0;    // [s] simulated time at which the charts end
  FilmClock clock;
  std::optional<Area> path;  // [m] where the robot drives while the film lasts; empty if not known
};

/// The estimators that a film of this world shows: those that the world file names for the film. If it names
/// none: seif and ekf, filled up to two with others.
std::vector<std::string> filmed_estimators(const worlds::World& world);

/// The clock of a film from `from` to `to`, both [s] of simulated time after the run's start. Throws BadInput
/// if there is nothing to film between them, or more than ten million frames.
FilmClock film_clock(const worlds::Film& film, double start, double end, std::optional<double> from,
                     std::optional<double> to);

/// The plan for a film of a whole live run.
FilmPlan film_plan(const worlds::World& world);

class Film final : public RunListener {
 public:
  /// Keeps a reference to `believers` and to the landmarks of `log`. Throws std::runtime_error if something
  /// is not installed, with a message that says what to install. Throws BadInput for an unknown estimator.
  Film(FilmPlan plan, const LogDescription& log, const Believers& believers, std::unique_ptr<FrameSink> sink);

  /// Calls `goes_on` after each frame. Once it returns false, no more frames are drawn.
  void after_each_frame(std::function<bool()> goes_on) { goes_on_ = std::move(goes_on); }

  /// An error of the film does not end the run; finish() reports it.
  void odometry(const OdometryEvent& event) override;
  void scan(const ScanEvent& event) override;
  void dead_reckoning(double t, const seif::Pose2& T_world_robot) override;
  void update(std::size_t estimator, const UpdateRecord& record) override;

  /// True if no further frame is wanted.
  bool is_over() const { return next_frame_ >= plan_.clock.frames() || !failure_.empty() || is_cut_; }
  std::int64_t frames_drawn() const { return next_frame_; }

  /// Ends the film after the run. If the run `has_ended` as planned, the remaining frames are drawn first.
  /// Throws std::runtime_error if the film could not be made.
  void finish(bool has_ended);

 private:
  void note_past(double t);
  void advance_to(double t, const std::optional<TruePose>& truth, const seif::Pose2& increment);
  void draw_frame(double t, const seif::Pose2& T_since);
  void compose(double t, const seif::Pose2& T_since);
  Gaze gaze_of(const render::Camera& camera, const seif::Pose2& robot) const;
  void compose_things(const Gaze& gaze, const seif::Pose2& T_since);
  void compose_overlay(double t);
  std::string facts_at(double t) const;
  seif::Pose2 best_pose(const seif::Pose2& T_since) const;

  FilmPlan plan_;
  const Believers& believers_;
  std::unique_ptr<FrameSink> sink_;
  render::Renderer renderer_;
  std::vector<std::size_t> filmed_;  // for each view, the index of its estimator in the run
  Layout layout_;
  Stage stage_;
  Sight sight_;
  CameraMan camera_man_;
  std::vector<BeliefView> views_;
  std::vector<LegendEntry> legend_;
  Trail true_trail_;
  Trail odometry_trail_;
  double t_;                       // [s] of the last event
  std::optional<TruePose> truth_;  // at the last event
  std::optional<TruePose> now_;    // the truth at the present frame
  FilmClock past_;                 // regular times before the first frame
  std::int64_t next_note_ = 0;     // index of the next time in `past_`
  std::int64_t next_frame_ = 0;
  std::function<bool()> goes_on_;
  bool is_cut_ = false;
  std::string failure_;
  render::Scene scene_;  // reused
  render::Image image_;  // reused
};

}  // namespace harness
