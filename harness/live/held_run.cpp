#include "harness/live/held_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

constexpr const char* is_recorded = "this is a recorded log: its world cannot be changed";
constexpr double longest_extension = 1e5;         // [s]
constexpr std::int64_t moves_between_looks = 64;  // [-] while it is simulated again

}  // namespace

HeldRun::HeldRun(LiveSource source, LiveChannels& channels, GoesOn goes_on)
    : source_(std::move(source)),
      channels_(channels),
      goes_on_(std::move(goes_on)),
      script_(source_.world, source_.resolved, source_.registry) {
  begin_anew();
}

void HeldRun::begin_anew() {
  run_.reset();  // its files and its memory first
  run_.emplace(source_, script_.world(), channels_, ++epoch_);
  version_ = 0;
  tell_setting();
}

void HeldRun::tell_setting() {
  const LiveSubject subject{script_.world(),  source_.knows_world,
                            run_->log(),      run_->believers(),
                            source_.registry, {run_->is_simulated(), true, is_recorded}};
  // What appears at the next step is shown already.
  channels_.outbox.set(
      std::make_shared<const LiveSetting>(live_setting(subject, now_or_later(), epoch_, ++version_)));
}

void HeldRun::rewind_to(double t) {
  begin_anew();
  if (const double more = t - source_.world.duration; run_->is_simulated() && more > 0.0)
    run_->simulation().extend(std::min(more, longest_extension));
  const double start = run_->t();
  const double rounding = run_->is_simulated() ? 0.5 * run_->simulation().step_s() : 0.0;
  for (std::int64_t moves = 1; run_->t() < t - rounding; ++moves) {
    if (run_->advance() == LiveRun::Advance::end) break;
    if (moves % moves_between_looks == 0 && !goes_on_((run_->t() - start) / std::max(t - start, 1e-9))) break;
  }
  run_->settle();
  tell_setting();
}

void HeldRun::forget_all() {
  script_ = Script(source_.world, source_.resolved, source_.registry);
  begin_anew();
}

double HeldRun::now_or_later() const {
  return run_->is_simulated() ? run_->simulation().next_step_t() : run_->t();
}

double HeldRun::intervention_t() {
  const double now = run_->t();
  const double rounding = run_->is_simulated() ? 1.5 * run_->simulation().step_s() : 0.0;
  if (script_.goes_on_after(now + rounding)) {
    script_.cut_after(now + rounding);
    rewind_to(now);
  }
  return now_or_later();
}

void HeldRun::inject(const std::string& yaml) {
  if (!run_->is_simulated()) throw BadInput(is_recorded);
  const worlds::Fault fault = script_.add_fault(fmt::format("{{at_s: {}, {}}}", intervention_t(), yaml));
  try {
    run_->simulation().inject(fault);
  } catch (const std::invalid_argument& error) {  // there is no room, for instance
    script_.take_back();
    throw BadInput(error.what());
  }
  if (fault.kind == worlds::FaultKind::landmark) run_->observer().look_at_landmarks();
  if (fault.kind != worlds::FaultKind::kidnapping && fault.kind != worlds::FaultKind::outlier) tell_setting();
}

void HeldRun::silence(worlds::FaultySensor sensor, bool begins) {
  if (!run_->is_simulated()) throw BadInput(is_recorded);
  const double t = intervention_t();
  if (begins == is_silent(sensor)) return;
  if (!begins && !script_.has_begun_silence(sensor))
    throw BadInput("the world file itself keeps this sensor silent for now");
  if (begins) {
    run_->simulation().inject(script_.begin_silence(sensor, t));
  } else {
    script_.end_silence(sensor, t);
    run_->simulation().end_silence(sensor, t);
  }
}

void HeldRun::change_option(const std::string& estimator, const std::string& option, double value) {
  intervention_t();
  const double t = run_->t();
  const worlds::Fault& fault = script_.add_fault(
      fmt::format("{{at_s: {}, kind: option, estimator: \"{}\", option: \"{}\", new_value: {}}}", t,
                  estimator, option, value));
  run_->loop().change({fault.at, fault.estimator, fault.option, fault.option_value});
}

void HeldRun::drive(double v, double omega) { take_over({intervention_t(), false, v, omega}); }

void HeldRun::release() { take_over({intervention_t(), true, 0.0, 0.0}); }

void HeldRun::take_over(const worlds::Takeover& row) {
  if (!run_->is_simulated()) throw BadInput(is_recorded);
  script_.take_over(row);
  run_->simulation().take_over(row);
}

std::string HeldRun::add_beside(const std::string& estimator, const std::string& option,
                                const seif::OptionValue& value) {
  std::string name = script_.add_beside(estimator, option, value);
  const double now = run_->t();
  rewind_to(now);
  return name;
}

bool HeldRun::is_by_hand() const {
  const std::vector<worlds::Takeover>& rows = script_.world().drive.takeover;
  const auto next = std::ranges::upper_bound(rows, now_or_later(), {}, &worlds::Takeover::t);
  return next != rows.begin() && !std::prev(next)->released;
}

bool HeldRun::is_silent(worlds::FaultySensor sensor) const {
  const double t = now_or_later();
  return std::ranges::any_of(script_.world().faults, [&](const worlds::Fault& fault) {
    return fault.kind == worlds::FaultKind::silence && fault.sensor == sensor && t + 1e-9 >= fault.at &&
           t + 1e-9 < fault.at + fault.duration;
  });
}

}  // namespace harness
