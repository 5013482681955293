#include "harness/live/live_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds frame_time{33};
constexpr std::chrono::milliseconds enough_to_look{2};
constexpr std::chrono::milliseconds patience{10};  // between two looks at the requests

std::string first_estimator(const worlds::World& world) {
  for (const worlds::EstimatorChoice& choice : world.estimators) {
    if (choice.type == "seif") return choice.name;
  }
  return world.estimators.empty() ? "" : world.estimators.front().name;
}

template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};

}  // namespace

LiveSession::LiveSession(LiveSource source, LiveChannels& channels, Plan plan, const std::atomic<bool>& stop)
    : channels_(channels), plan_(std::move(plan)), stop_(stop), watched_(first_estimator(source.world)) {
  held_.emplace(std::move(source), channels, [this](double progress) {
    state_ = LiveState::rewinding;
    progress_ = progress;
    publish();
    return !stop_;
  });
  pacer_.set_speed(plan_.speed, held_->run().t(), Clock::now());
  set_goal(plan_.is_paused ? Goal::none : Goal::go);
}

LiveStatus LiveSession::status(bool is_idle) const {
  return {state_,
          progress_,
          pacer_.speed(),
          pacer_.measured(),
          held_->is_by_hand(),
          held_->is_silent(worlds::FaultySensor::landmark_sensor),
          held_->is_silent(worlds::FaultySensor::encoders),
          watched_,
          is_idle};
}

void LiveSession::run() {
  while (!stop_) {
    for (const Request& request : std::exchange(deferred_, {})) answer(request);
    while (const std::optional<Request> request = channels_.requests.pop()) answer(*request);
    if (goal_ == Goal::none) {
      publish(true);
      channels_.requests.wait_until(Clock::now() + frame_time);
    } else {
      move();
    }
  }
}

/// Takes the run a little further towards its goal.
void LiveSession::move() {
  const Clock::time_point end = Clock::now() + patience;
  for (Clock::time_point now = Clock::now(); goal_ != Goal::none && now < end && !stop_; now = Clock::now()) {
    if (goal_ == Goal::go) {
      const Clock::time_point due = pacer_.due(held_->run().t(), now);
      if (due > now) {
        publish(due - now > enough_to_look);
        return channels_.requests.wait_until(std::min(due, now + frame_time));
      }
    }
    advance();
    arrive();
  }
  publish();
}

void LiveSession::advance() {
  bool has_ended = true;
  try {
    has_ended = held_->run().advance() == LiveRun::Advance::end;
  } catch (const std::system_error&) {
    throw;  // the record cannot be written
  } catch (const std::exception& error) {
    channels_.outbox.send({{}, said(true, error.what(), 0)});
  }
  if (!has_ended) return;
  set_goal(Goal::none);
  state_ = LiveState::ended;
}

/// Stops at the goal, if it is reached.
void LiveSession::arrive() {
  const bool is_there = (goal_ == Goal::step && held_->run().steps() >= goal_count_) ||
                        (goal_ == Goal::update && held_->run().updates() >= goal_count_);
  if (is_there) set_goal(Goal::none);
}

void LiveSession::set_goal(Goal goal, std::int64_t count) {
  LiveRun& run = held_->run();
  const bool is_on_its_way = goal == goal_;  // a second step is asked for before the first is done
  goal_ = goal;
  if (goal == Goal::step) goal_count_ = (is_on_its_way ? goal_count_ : run.steps()) + count;
  if (goal == Goal::update) goal_count_ = (is_on_its_way ? goal_count_ : run.updates()) + count;
  if (goal == Goal::go) pacer_.restart(run.t(), Clock::now());
  state_ = goal == Goal::none ? LiveState::paused : LiveState::running;
  if (goal != Goal::stage) {
    run.loop().watch_stages({});
    before_.reset();
    return;
  }
  if (const LiveEstimator* estimator = watched()) before_ = picture_of(*estimator->filter, run.latest_scan());
  run.loop().watch_stages(
      [this](std::size_t estimator, seif::Stage stage) { watch_stage(estimator, stage); });
}

const LiveEstimator* LiveSession::watched() const {
  const std::vector<LiveEstimator>& estimators = held_->run().believers().estimators;
  const auto it = std::ranges::find(estimators, watched_, &LiveEstimator::name);
  return it == estimators.end() || !it->failure.empty() ? nullptr : &*it;
}

/// Called in the middle of an update.
void LiveSession::watch_stage(std::size_t index, seif::Stage stage) {
  const LiveEstimator& estimator = held_->run().believers().estimators[index];
  if (goal_ != Goal::stage || estimator.name != watched_) return;
  const seif::Scan& scan = held_->run().latest_scan();
  BeliefPicture after = picture_of(*estimator.filter, scan);
  const std::vector<worlds::EstimatorChoice>& choices = held_->script().world().estimators;
  const auto choice = std::ranges::find(choices, estimator.name, &worlds::EstimatorChoice::name);
  const std::string& type = choice == choices.end() ? estimator.name : choice->type;
  channels_.outbox.send({{},
                         stage_message({estimator.name, type, stage, scan.t}, *estimator.filter, scan,
                                       before_.value_or(after), after)});
  before_ = std::move(after);
  hold_stage();
}

/// Waits for what comes next. What cannot be done in the middle of an update is done after it.
void LiveSession::hold_stage() {
  state_ = LiveState::stage;
  while (!stop_) {
    publish(true);
    channels_.requests.wait_until(Clock::now() + frame_time);
    if (const std::optional<Request> request = channels_.requests.pop()) {
      if (leave_stage(*request)) return;
    }
  }
}

bool LiveSession::leave_stage(const Request& request) {
  const Ask& ask = request.ask;
  if (std::holds_alternative<asks::Pause>(ask)) return false;
  const bool ends_update = std::holds_alternative<asks::Go>(ask) ||
                           std::holds_alternative<asks::Update>(ask) ||
                           std::holds_alternative<asks::Step>(ask);
  if (!ends_update && !std::holds_alternative<asks::Stage>(ask)) {
    tell(request, "this will be done when the update has ended: press U");
    deferred_.push_back(request);
    return false;
  }
  state_ = LiveState::running;
  if (!ends_update) return true;
  before_.reset();
  goal_ = std::holds_alternative<asks::Go>(ask) ? Goal::go : Goal::update;
  goal_count_ = held_->run().updates();  // this update counts already
  pacer_.restart(held_->run().t(), Clock::now());
  return true;
}

void LiveSession::tell(const Request& request, std::string_view text, bool is_error) {
  channels_.outbox.send({request.page, said(is_error, text, request.seq)});
}

void LiveSession::answer(const Request& request) {
  try {
    if (!control(request)) intervene(request);
  } catch (const BadInput& error) {
    tell(request, error.what(), true);
  }
}

/// Goes on; a world that has come to its end goes on for as long again.
void LiveSession::go() {
  LiveRun& run = held_->run();
  if (state_ == LiveState::ended && run.is_simulated())
    run.simulation().extend(held_->source().world.duration);
  set_goal(Goal::go);
}

/// What changes nothing but the moment that is looked at. False if the request is of another kind.
bool LiveSession::control(const Request& request) {
  bool is_known = true;
  std::visit(Overloaded{[&](const asks::Pause&) { set_goal(Goal::none); }, [&](const asks::Go&) { go(); },
                        [&](const asks::Step& wanted) { set_goal(Goal::step, wanted.count); },
                        [&](const asks::Update& wanted) { set_goal(Goal::update, wanted.count); },
                        [&](const asks::Stage&) { set_goal(Goal::stage); },
                        [&](const asks::Speed& wanted) {
                          pacer_.set_speed(wanted.factor, held_->run().t(), Clock::now());
                        },
                        [&](const asks::Back& wanted) {
                          held_->rewind_to(wanted.t);
                          set_goal(Goal::none);
                        },
                        [&](const asks::Again&) {
                          held_->forget_all();
                          set_goal(Goal::none);
                        },
                        [&](const asks::Watch& wanted) { watched_ = wanted.estimator; },
                        [&](const asks::Inspect& wanted) { inspect(request, wanted); },
                        [&](const asks::Save& wanted) { save(request, wanted.what); },
                        [&](const auto&) { is_known = false; }},
             request.ask);
  return is_known;
}

/// What changes the run.
bool LiveSession::intervene(const Request& request) {
  bool is_known = true;
  HeldRun& held = *held_;
  const std::uint64_t epoch = held.epoch();
  const Goal goal = goal_;
  std::visit(Overloaded{[&](const asks::Drive& w) { held.drive(w.v, w.omega); },
                        [&](const asks::Release&) { held.release(); },
                        [&](const asks::Kidnap& w) {
                          held.inject(fmt::format("kind: kidnapping, x_m: {}, y_m: {}, heading_deg: {}", w.x,
                                                  w.y, w.heading_deg));
                        },
                        [&](const asks::Silence& w) { held.silence(w.sensor, w.begins); },
                        [&](const asks::Outlier& w) {
                          held.inject(fmt::format("kind: outlier, size_sigma: {}", w.size_sigma));
                        },
                        [&](const asks::Ice& w) {
                          held.inject(fmt::format("kind: ice, min_m: [{}, {}], max_m: [{}, {}], friction: {}",
                                                  w.min.x(), w.min.y(), w.max.x(), w.max.y(), w.friction));
                        },
                        [&](const asks::Wall& w) {
                          std::string points;
                          for (const Eigen::Vector2d& p : w.points)
                            points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", p.x(), p.y());
                          held.inject(fmt::format("kind: wall, points_m: [{}]", points));
                        },
                        [&](const asks::Landmark& w) {
                          held.inject(fmt::format("kind: landmark, x_m: {}, y_m: {}", w.x, w.y));
                        },
                        [&](const asks::Option& w) {
                          held.change_option(w.estimator, w.option, w.value);
                          tell(request, fmt::format("{}: {} is {} from the next measurement on", w.estimator,
                                                    w.option, w.value));
                        },
                        [&](const asks::Beside& w) {
                          tell(request, fmt::format("{} runs beside",
                                                    held.add_beside(w.estimator, w.option, w.value)));
                        },
                        [&](const auto&) { is_known = false; }},
             request.ask);
  if (held.epoch() != epoch) set_goal(goal == Goal::go ? goal : Goal::none);  // it was simulated again
  return is_known;
}

void LiveSession::inspect(const Request& request, const asks::Inspect& wanted) {
  const LiveRun& run = held_->run();
  const std::vector<LiveEstimator>& estimators = run.believers().estimators;
  const auto estimator = std::ranges::find(estimators, wanted.estimator, &LiveEstimator::name);
  if (estimator == estimators.end())
    throw BadInput(fmt::format("there is no estimator '{}'", wanted.estimator));
  std::optional<Eigen::Vector2d> truth;
  if (run.log().landmarks && estimator->filter->needs_names()) {
    const auto it =
        std::ranges::lower_bound(*run.log().landmarks, wanted.landmark, {}, &TrueLandmark::landmark);
    if (it != run.log().landmarks->end() && it->landmark == wanted.landmark) truth = it->position;
  }
  channels_.outbox.send(
      {request.page, landmark_message(*estimator, wanted.landmark, truth, run.sightings())});
}

void LiveSession::save(const Request& request, const std::string& what) {
  LiveRun& run = held_->run();
  if (!run.is_simulated()) throw BadInput("a recorded log is saved already");
  run.settle();
  if (run.updates() == 0) throw BadInput("there is nothing to save before the first scan");
  tell(request, "saving: what was done is run again, from the file that holds it");
  plan_.save({request.page, request.seq, what, held_->source().world.name, run.t(), run.hash_so_far()},
             held_->script());
}

}  // namespace harness
