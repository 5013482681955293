// The interface of an estimator that exchanges news with those of other robots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seif {

/// What an estimator has exchanged so far.
struct TeamCounts {
  std::int64_t told_pieces = 0;    // [-] of its own map
  std::int64_t told_bytes = 0;     // [byte] of these
  std::int64_t heard_pieces = 0;   // [-] of other robots
  std::int64_t learnt_pieces = 0;  // [-] of these, in its map
  std::vector<double> joined_t =
      {};  // [s] when the first piece of each robot came into its map; NaN: none yet
};

/// Estimators that can exchange news return this from Estimator::team_member().
class TeamMember {
 public:
  virtual ~TeamMember() = default;

  /// This is robot number `robot` of so many. Before anything else.
  virtual void enter_team(std::size_t robot, std::size_t robots) = 0;

  /// The next packet that is to be broadcast at time t [s]. False if there is nothing to say now.
  virtual bool speak(double t, std::vector<std::byte>& packet) = 0;

  /// A packet that another robot of the team has broadcast. Packets may be lost, late, cut off, or come twice.
  virtual void hear(double t, std::span<const std::byte> packet) = 0;

  virtual TeamCounts team_counts() const = 0;
};

}  // namespace seif
