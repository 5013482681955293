#include "harness/team/team_exchange.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "seif/team/news_book.hpp"
#include "sensors/random_stream.hpp"
#include "worlds/team.hpp"

namespace harness {

namespace {

static_assert(worlds::most_robots_of_team <= seif::most_robots);

/// The estimator of this name if it exchanges, or null.
const LiveEstimator* find(const TeamMember& robot, const std::string& name) {
  const std::vector<LiveEstimator>& all = robot.run.believers->estimators;
  const auto found = std::ranges::find(all, name, &LiveEstimator::name);
  return found == all.end() || found->filter->team_member() == nullptr ? nullptr : &*found;
}

}  // namespace

TeamExchange::TeamExchange(Team& team) : team_(team), positions_(team.members.size()) {
  std::set<std::string> names;
  for (const TeamMember& robot : team.members) {
    for (const LiveEstimator& estimator : robot.run.believers->estimators) {
      if (estimator.filter->team_member() != nullptr) names.insert(estimator.name);
    }
  }
  for (const std::string& name : names) add_channel(name);
}

void TeamExchange::add_channel(const std::string& name) {
  std::vector<const LiveEstimator*> estimators;
  std::vector<seif::TeamMember*> members;
  for (const TeamMember& robot : team_.members) {
    const LiveEstimator* const estimator = estimators.emplace_back(find(robot, name));
    members.push_back(estimator == nullptr ? nullptr
                                           : &heard_.emplace_back(*estimator->filter->team_member(),
                                                                  heard_file(robot.run.plan.folder, name)));
  }
  channels_.push_back(
      {name, std::move(estimators),
       Radio(team_.radio, std::move(members), sensors::random_stream(team_.seed, "radio/" + name))});
}

void TeamExchange::exchange(double t) {
  for (std::size_t i = 0; i < positions_.size(); ++i)
    positions_[i] = team_.members[i].stream->robot().position;
  for (Channel& channel : channels_) {
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const LiveEstimator* const estimator = channel.estimators[i];
      if (estimator != nullptr && !estimator->failure.empty()) channel.radio.silence(i);
    }
    channel.radio.exchange(t, positions_);
  }
}

void TeamExchange::close() {
  for (HeardPackets& heard : heard_) heard.close();
}

std::vector<ExchangeSummary> TeamExchange::of_robot(std::size_t robot) const {
  std::vector<ExchangeSummary> all;
  for (const Channel& channel : channels_) {
    if (const LiveEstimator* const estimator = channel.estimators[robot])
      all.push_back(
          {channel.name, channel.radio.sent_bytes(robot), estimator->filter->team_member()->team_counts()});
  }
  return all;
}

}  // namespace harness
