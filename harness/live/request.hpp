// What a page asks for, and the queue in which it waits for the run.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harness/web/page_server.hpp"
#include "seif/registry.hpp"
#include "seif/types.hpp"
#include "worlds/fault.hpp"

namespace harness {

namespace asks {
struct Pause {};
struct Go {};
struct Step {
  std::int64_t count = 1;  // [-] steps of the physics
};
struct Update {
  std::int64_t count = 1;  // [-] to the end of so many updates
};
struct Stage {};    // to the end of the next stage of an update
struct Again {};    // from the beginning
struct Release {};  // gives the wheel back to the drive
struct Speed {
  double factor = 1.0;  // [-] infinity: as fast as it goes
};
struct Back {
  double t = 0.0;  // [s]
};
struct Drive {
  double v = 0.0;      // [m/s]
  double omega = 0.0;  // [rad/s]
};
struct Kidnap {
  double x = 0.0, y = 0.0;   // [m]
  double heading_deg = 0.0;  // [deg]
};
struct Silence {
  worlds::FaultySensor sensor = worlds::FaultySensor::landmark_sensor;
  bool begins = true;
};
struct Outlier {
  double size_sigma = 0.0;  // [sigma]
};
struct Ice {
  Eigen::Vector2d min, max;  // [m]
  double friction = 0.0;     // [-]
};
struct Wall {
  std::vector<Eigen::Vector2d> points;  // [m]
};
struct Landmark {
  double x = 0.0, y = 0.0;  // [m]
};
struct Option {
  std::string estimator, option;
  double value = 0.0;
};
/// A copy of an estimator gets this value from the beginning, and runs beside it.
struct Beside {
  std::string estimator, option;
  seif::OptionValue value;
};
struct Inspect {
  std::string estimator;
  seif::LandmarkId landmark = seif::no_landmark;
};
struct Watch {
  std::string estimator;
};
struct Save {
  std::string what;  // run, film or report
};
/// What a page shows. Nobody but the pages' own thread needs the rest of it.
struct View {
  Eigen::Vector2d min = Eigen::Vector2d::Zero(), max = Eigen::Vector2d::Zero();  // [m]
  bool matrix = false;
  bool links = true;
};
}  // namespace asks

using Ask = std::variant<asks::Pause, asks::Go, asks::Step, asks::Update, asks::Stage, asks::Again,
                         asks::Release, asks::Speed, asks::Back, asks::Drive, asks::Kidnap, asks::Silence,
                         asks::Outlier, asks::Ice, asks::Wall, asks::Landmark, asks::Option, asks::Beside,
                         asks::Inspect, asks::Watch, asks::Save, asks::View>;

struct Request {
  PageId page = 0;
  std::int64_t seq = 0;  // the page's own number, for the answer
  Ask ask;
};

/// Reads a request. Throws BadInput that says what is wrong with it: it may be any text.
Request read_request(std::string_view json);

/// A bounded queue between two threads.
class RequestQueue {
 public:
  /// False if too many are waiting.
  [[nodiscard]] bool push(Request request);

  /// The oldest one; nothing if there is none, and at once.
  std::optional<Request> pop();

  /// Waits until there is a request, at most until then.
  void wait_until(std::chrono::steady_clock::time_point end);

 private:
  static constexpr std::size_t most = 256;  // [-]

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Request> requests_;
};

}  // namespace harness
