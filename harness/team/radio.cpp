#include "harness/team/radio.hpp"

#include <algorithm>
#include <utility>

namespace harness {

Radio::Radio(const worlds::Radio& radio, std::vector<seif::TeamMember*> members, std::mt19937_64 random)
    : radio_(radio),
      members_(std::move(members)),
      random_(random),
      busy_until_(members_.size(), 0.0),
      sent_bytes_(members_.size(), 0) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i] != nullptr) members_[i]->enter_team(i, members_.size());
  }
}

void Radio::exchange(double t, std::span<const Eigen::Vector2d> positions) {
  deliver(t);
  for (std::size_t from = 0; from < members_.size(); ++from) {
    if (members_[from] == nullptr) continue;
    while (busy_until_[from] <= t && members_[from]->speak(t, packet_)) broadcast(t, from, positions);
  }
}

void Radio::deliver(double t) {
  for (; !on_air_.empty() && on_air_.front().due_t <= t; on_air_.pop_front()) {
    if (seif::TeamMember* const to = members_[on_air_.front().to]) to->hear(t, on_air_.front().bytes);
  }
}

/// The sender is busy for as long as the packet takes.
void Radio::broadcast(double t, std::size_t from, std::span<const Eigen::Vector2d> positions) {
  busy_until_[from] = std::max(t, busy_until_[from]) + static_cast<double>(packet_.size()) / radio_.rate;
  sent_bytes_[from] += static_cast<std::int64_t>(packet_.size());
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  for (std::size_t to = 0; to < members_.size(); ++to) {
    if (to == from || members_[to] == nullptr) continue;
    if ((positions[to] - positions[from]).norm() > radio_.range) continue;
    if (chance(random_) < radio_.loss) continue;
    Packet& packet = on_air_.emplace_back(Packet{t + radio_.delay, to, packet_});
    if (chance(random_) < radio_.cut_off)
      packet.bytes.resize(static_cast<std::size_t>(chance(random_) * static_cast<double>(packet_.size())));
  }
}

}  // namespace harness
