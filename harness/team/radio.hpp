// Carries packets between the robots of a team: within range, late, cut off, or not at all.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <span>
#include <vector>

#include "seif/team/team_member.hpp"
#include "worlds/radio.hpp"

namespace harness {

/// For one estimator of each robot.
class Radio {
 public:
  /// `members[i]` belongs to robot i; null: this robot has no such estimator.
  Radio(const worlds::Radio& radio, std::vector<seif::TeamMember*> members, std::mt19937_64 random);

  /// Lets the robots speak and hear. `positions`: where they are at time t [s], in the world [m].
  void exchange(double t, std::span<const Eigen::Vector2d> positions);

  std::int64_t sent_bytes(std::size_t from) const { return sent_bytes_[from]; }
  /// From now on the robot says and hears nothing.
  void silence(std::size_t whom) { members_[whom] = nullptr; }

 private:
  struct Packet {
    double due_t;  // [s]
    std::size_t to;
    std::vector<std::byte> bytes;
  };
  void deliver(double t);
  void broadcast(double t, std::size_t from, std::span<const Eigen::Vector2d> positions);

  worlds::Radio radio_;
  std::vector<seif::TeamMember*> members_;
  std::mt19937_64 random_;
  std::deque<Packet> on_air_;  // in the order of their times
  std::vector<std::byte> packet_;
  std::vector<double> busy_until_;        // [s] each robot
  std::vector<std::int64_t> sent_bytes_;  // [byte]
};

}  // namespace harness
