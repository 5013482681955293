#include "harness/team/team_exchange.hpp"

#include <cstddef>
#include <set>
#include <utility>

#include "sensors/random_stream.hpp"

namespace harness {

namespace {

LiveEstimator* find(TeamMember& robot, const std::string& name) {
  for (LiveEstimator& estimator : robot.run.believers->estimators) {
    if (estimator.name == name) return &estimator;
  }
  return nullptr;
}

}  // namespace

TeamExchange::TeamExchange(Team& team) : team_(team), positions_(team.members.size()) {
  std::set<std::string> names;
  for (TeamMember& robot : team.members) {
    for (const LiveEstimator& estimator : robot.run.believers->estimators) {
      if (estimator.filter->team_member() != nullptr) names.insert(estimator.name);
    }
  }
  for (const std::string& name : names) {
    std::vector<seif::TeamMember*> members;
    for (TeamMember& robot : team.members) {
      LiveEstimator* estimator = find(robot, name);
      seif::TeamMember* const member = estimator == nullptr ? nullptr : estimator->filter->team_member();
      members.push_back(member == nullptr
                            ? nullptr
                            : &heard_.emplace_back(*member, heard_file(robot.run.plan.folder, name)));
    }
    radios_.try_emplace(name, team.radio, std::move(members),
                        sensors::random_stream(team.seed, "radio/" + name));
  }
}

void TeamExchange::exchange(double t) {
  for (std::size_t i = 0; i < positions_.size(); ++i)
    positions_[i] = team_.members[i].stream->robot().position;
  for (auto& [name, radio] : radios_) {
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const LiveEstimator* estimator = find(team_.members[i], name);
      if (estimator != nullptr && !estimator->failure.empty()) radio.silence(i);
    }
    radio.exchange(t, positions_);
  }
}

void TeamExchange::close() {
  for (HeardPackets& heard : heard_) heard.close();
}

std::vector<ExchangeSummary> TeamExchange::of_robot(std::size_t robot) const {
  std::vector<ExchangeSummary> all;
  for (const auto& [name, radio] : radios_) {
    const LiveEstimator* estimator = find(team_.members[robot], name);
    if (estimator == nullptr || estimator->filter->team_member() == nullptr) continue;
    all.push_back({name, radio.sent_bytes(robot), estimator->filter->team_member()->team_counts()});
  }
  return all;
}

}  // namespace harness
