#include <cmath>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <variant>

#include "archive.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/readers/open_log.hpp"
#include "harness/recording/run_folder.hpp"
#include "targets.hpp"

namespace fuzz {

namespace {

void check(const harness::OdometryEvent& event, bool /*names_landmarks*/) {
  const seif::Pose2& T = event.odometry.T_previous_current;
  if (!std::isfinite(event.odometry.t + T.x + T.y + T.theta) || !event.odometry.covariance.allFinite())
    std::abort();
}

void check(const harness::ScanEvent& event, bool names_landmarks) {
  for (const seif::Observation& seen : event.scan.observations) {
    if (!std::isfinite(seen.range + seen.bearing) || seen.range < 0.0 || !seen.covariance.allFinite())
      std::abort();
    if (names_landmarks != (seen.landmark >= 0)) std::abort();
  }
}

}  // namespace

/// All values that a reader delivers are finite, and time does not run backwards.
void read_log(std::string_view bytes) {
  const harness::TemporaryFolder folder;
  const auto files = unpack(bytes, folder.path());
  try {
    const auto log = harness::open_log({.path = files.size() == 1 ? files.front() : folder.path()});
    const bool names_landmarks = log->description().known_association;
    double t = log->description().start_t;
    for (harness::Event event; log->next(event);) {
      std::visit([&](const auto& some) { check(some, names_landmarks); }, event);
      const auto* odometry = std::get_if<harness::OdometryEvent>(&event);
      const double now =
          odometry != nullptr ? odometry->odometry.t : std::get<harness::ScanEvent>(event).scan.t;
      if (now < t) std::abort();
      t = now;
    }
  } catch (const harness::BadInput&) {
  }
}

}  // namespace fuzz
