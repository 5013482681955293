#include "worlds/path.hpp"

#include <algorithm>
#include <cmath>

namespace worlds {
namespace {

/// Positions of a unicycle that follows the commands exactly, at most `step` [s] apart in time.
std::vector<Eigen::Vector2d> commanded_path(const Placement& start,
                                            const std::vector<VelocityCommand>& commands, double duration) {
  constexpr double step = 0.1;
  std::vector<Eigen::Vector2d> path = {start.position};
  double heading = start.heading;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const VelocityCommand& command = commands[i];
    const double end = i + 1 < commands.size() ? std::min(commands[i + 1].t, duration) : duration;
    if (command.v == 0 && command.omega == 0) continue;
    for (double t = command.t; t < end;) {
      const double dt = std::min(step, end - t);
      const double middle = heading + 0.5 * command.omega * dt;
      path.push_back(path.back() + command.v * dt * Eigen::Vector2d(std::cos(middle), std::sin(middle)));
      heading += command.omega * dt;
      t = dt < step ? end : t + step;
    }
  }
  return path;
}

}  // namespace

std::vector<Eigen::Vector2d> serpentine(const Eigen::Vector2d& min, const Eigen::Vector2d& max, double lane) {
  // The margin keeps rounding from adding a lane to an area that is a whole number of lanes wide.
  constexpr double margin = 1e-9;
  const double width = max.y() - min.y();
  const auto gaps = static_cast<int>(std::ceil(width / lane - margin));
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i <= gaps; ++i) {
    const double y = gaps == 0 ? min.y() : min.y() + width * i / gaps;
    const bool forwards = i % 2 == 0;
    corners.emplace_back(forwards ? min.x() : max.x(), y);
    corners.emplace_back(forwards ? max.x() : min.x(), y);
  }
  return corners;
}

std::vector<Eigen::Vector2d> driven_path(const World& world) {
  return driven_path(world.robot.start, world.drive, world.duration);
}

std::vector<Eigen::Vector2d> driven_path(const Placement& start, const Drive& drive, double duration) {
  if (drive.mode == DriveMode::commands) return commanded_path(start, drive.commands, duration);
  std::vector<Eigen::Vector2d> path = {start.position};
  path.insert(path.end(), drive.path.begin(), drive.path.end());
  if (drive.closed && !drive.path.empty()) path.push_back(drive.path.front());
  return path;
}

}  // namespace worlds
