// What the estimators of a team exchange: those of one name talk with each other.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "harness/run/heard_packets.hpp"
#include "harness/team/radio.hpp"
#include "harness/team/team.hpp"
#include "seif/team/team_member.hpp"

namespace harness {

/// What one estimator of one robot has exchanged.
struct ExchangeSummary {
  std::string estimator;
  std::int64_t sent_bytes = 0;  // [byte]
  seif::TeamCounts counts;
};

class TeamExchange {
 public:
  /// Keeps a reference to the team. Opens a file in the folder of each robot (heard_file).
  explicit TeamExchange(Team& team);

  /// At time t [s]. An estimator that has failed is silent.
  void exchange(double t);

  /// After the last exchange.
  void close();

  std::vector<ExchangeSummary> of_robot(std::size_t robot) const;

 private:
  /// Estimators of one name, by robot. Null: this one has none that exchanges.
  struct Channel {
    std::string name;
    std::vector<const LiveEstimator*> estimators;
    Radio radio;
  };
  void add_channel(const std::string& name);

  Team& team_;
  std::deque<HeardPackets> heard_;  // of all robots and estimators
  std::vector<Channel> channels_;
  std::vector<Eigen::Vector2d> positions_;  // [m] of the robots; kept so that no exchange allocates
};

}  // namespace harness
