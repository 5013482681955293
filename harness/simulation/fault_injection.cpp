#include "harness/simulation/fault_injection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace harness {

namespace {

using worlds::Fault;
using worlds::FaultKind;

bool has_come(const Fault& fault, double t) { return t >= fault.at - time_rounding; }

double bad_range(worlds::BadValue value) {
  constexpr double absurd = 1e6;  // [m]
  switch (value) {
    case worlds::BadValue::nan:
      return std::numeric_limits<double>::quiet_NaN();
    case worlds::BadValue::infinite:
      return std::numeric_limits<double>::infinity();
    case worlds::BadValue::absurd:
      break;
  }
  return absurd;
}

}  // namespace

FaultInjection::FaultInjection(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) faults_.push_back({fault});
}

void FaultInjection::end_silence(worlds::FaultySensor sensor, double t) {
  for (auto& [fault, is_done] : faults_) {
    if (fault.kind == FaultKind::silence && fault.sensor == sensor && fault.duration == worlds::open_end)
      fault.duration = t - fault.at;
  }
}

const Fault* FaultInjection::thing(double t) {
  Pending* first = nullptr;
  for (Pending& pending : faults_) {
    const FaultKind kind = pending.fault.kind;
    const bool appears = kind == FaultKind::ice || kind == FaultKind::wall || kind == FaultKind::landmark;
    if (!appears || pending.is_done || !has_come(pending.fault, t)) continue;
    if (first == nullptr || pending.fault.at < first->fault.at) first = &pending;
  }
  if (first == nullptr) return nullptr;
  first->is_done = true;
  return &first->fault;
}

std::vector<worlds::Landmark> FaultInjection::landmarks_to_come() const {
  std::vector<Fault> to_come;
  for (const auto& [fault, is_done] : faults_) {
    if (fault.kind == FaultKind::landmark && !is_done) to_come.push_back(fault);
  }
  std::ranges::stable_sort(to_come, {}, &Fault::at);
  std::vector<worlds::Landmark> landmarks;
  for (const Fault& fault : to_come) landmarks.push_back(fault.landmark);
  return landmarks;
}

std::optional<worlds::Placement> FaultInjection::kidnapping(double t) {
  std::optional<worlds::Placement> last;
  for (auto& [fault, is_done] : faults_) {
    if (fault.kind != FaultKind::kidnapping || is_done || !has_come(fault, t)) continue;
    is_done = true;
    last = fault.to;
  }
  return last;
}

bool FaultInjection::is_silent(worlds::FaultySensor sensor, double t) const {
  for (const auto& [fault, is_done] : faults_) {
    if (fault.kind == FaultKind::silence && fault.sensor == sensor && has_come(fault, t) &&
        t < fault.at + fault.duration - time_rounding)
      return true;
  }
  return false;
}

WheelJumps FaultInjection::encoder_jumps(double t) const {
  WheelJumps jumps;
  for (const auto& [fault, is_done] : faults_) {
    if (fault.kind != FaultKind::encoder_jump || !has_come(fault, t)) continue;
    (fault.wheel == worlds::Wheel::left ? jumps.left : jumps.right) += fault.jump;
  }
  return jumps;
}

void FaultInjection::spoil(seif::Scan& scan) {
  if (scan.observations.empty()) return;
  seif::Observation& seen = scan.observations.front();
  for (auto& [fault, is_done] : faults_) {
    const bool spoils = fault.kind == FaultKind::bad_observation || fault.kind == FaultKind::outlier;
    if (!spoils || is_done || !has_come(fault, scan.t)) continue;
    is_done = true;
    if (fault.kind == FaultKind::bad_observation) {
      seen.range = bad_range(fault.value);
    } else {
      seen.bearing = seif::wrap_angle(seen.bearing + fault.size * std::sqrt(seen.covariance(1, 1)));
    }
  }
}

}  // namespace harness
