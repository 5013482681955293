// Two robots that drive in one world, each with a frame of its own, and tell each other what they learn.
#pragma once

#include <cstddef>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "seif/path_drive.hpp"
#include "seif/team/team_filter.hpp"

namespace seif::test {

/// As drawn from its covariance.
inline EstimatorSetup with_error_of_start(EstimatorSetup setup, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d sd = setup.start.covariance.diagonal().cwiseSqrt();
  setup.start.mean.x += sd.x() * normal(random);
  setup.start.mean.y += sd.y() * normal(random);
  setup.start.mean.theta += sd.z() * normal(random);
  return setup;
}

struct Teammate {
  Teammate(PathDrive path, const TeamOptions& options, unsigned seed_of_start,
           const SeifOptions& of_seif = {})
      : drive(std::move(path)),
        filter(std::make_unique<TeamFilter>(
            std::make_unique<Seif>(with_error_of_start(drive.setup(), seed_of_start), of_seif), options)) {}

  bool advance() {
    if (drive.at_end()) return false;
    drive.advance();
    filter->motion_update(drive.odometry());
    filter->measurement_update(drive.scan(), [](Stage) {});
    return true;
  }

  PathDrive drive;
  std::unique_ptr<TeamFilter> filter;
};

/// Everybody hears everything at once.
inline void talk(std::vector<Teammate>& team, double t) {
  std::vector<std::byte> packet;
  for (std::size_t from = 0; from < team.size(); ++from) {
    while (team[from].filter->speak(t, packet)) {
      for (std::size_t to = 0; to < team.size(); ++to) {
        if (to != from) team[to].filter->hear(t, packet);
      }
    }
  }
}

}  // namespace seif::test
