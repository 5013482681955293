#include "seif/team/team_filter.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seif/team/packet.hpp"
#include "seif/team/tree_news.hpp"

namespace seif {
namespace {

constexpr double beacon_period = 1.0;        // [s]
constexpr int look_again_after = 5;          // [-] updates, if there was no place for any
constexpr std::size_t most_looked_at = 100;  // [-] waiting pieces in an update

}  // namespace

TeamFilter::TeamFilter(std::unique_ptr<Seif> filter, const TeamOptions& options)
    : FilterAround(std::move(filter)),
      seif_(static_cast<Seif&>(*filter_)),
      options_(options),
      sum_(static_cast<std::size_t>(options.most_told)) {
  if (seif_.news() == nullptr) throw std::invalid_argument("multi_seif needs mean_recovery: tree");
}

void TeamFilter::enter_team(std::size_t robot, std::size_t robots) {
  robot_ = robot;
  book_.emplace(robot, robots);
  counts_.joined_t.assign(robots, std::numeric_limits<double>::quiet_NaN());
  seif_.tell_frozen_to([this](const FrozenPiece& piece) { note(piece); });
}

void TeamFilter::measurement_update(const Scan& scan, const StageDone& done) {
  FilterAround::measurement_update(scan, done);
  if (!book_) return;
  if (++untold_updates_ >= options_.tell_after) tell();
  if (++deaf_updates_ >= options_.listen_after && seif_.news()->is_welcome()) learn(scan.t);
}

void TeamFilter::note(const FrozenPiece& piece) {
  if (piece.members.empty()) return;
  if (!sum_.has_room_for(piece, seif_.state())) tell();
  sum_.add(piece, seif_.state());
}

void TeamFilter::tell() {
  untold_updates_ = 0;
  if (sum_.is_empty()) return;
  const std::optional<TeamPiece> piece = sum_.take();
  if (!piece) return;
  std::vector<std::byte> bytes = encode(*piece);
  ++counts_.told_pieces;
  counts_.told_bytes += static_cast<std::int64_t>(bytes.size());
  book_->add_own(std::move(bytes));
}

/// Adds waiting pieces to the map, each where it shares landmarks with it. Looks at a few of them, in turns.
void TeamFilter::learn(double t) {
  int landmarks = 0;
  seif_.news()->begin();
  const std::size_t looks = std::min(most_looked_at, waiting_.size());
  for (std::size_t i = 0; i < looks && landmarks < options_.most_learnt; ++i) {
    auto next = waiting_.upper_bound(looked_at_);
    if (next == waiting_.end()) next = waiting_.begin();
    looked_at_ = next->first;
    if (!seif_.news()->has_place_for(next->second.outline)) continue;
    landmarks += static_cast<int>(next->second.outline.size());
    learn(next->first, next->second.bytes, t);
    waiting_.erase(next);
  }
  deaf_updates_ =
      landmarks > 0 ? 0 : options_.listen_after - std::min(look_again_after, options_.listen_after);
  if (landmarks > 0) seif_.news()->finish();
}

void TeamFilter::learn(const PieceName& name, std::span<const std::byte> bytes, double t) {
  seif_.news()->add(decode(bytes).value());
  ++counts_.learnt_pieces;
  double& joined_t = counts_.joined_t[name.robot];
  if (!(joined_t >= 0.0)) joined_t = t;
}

bool TeamFilter::speak(double t, std::vector<std::byte>& packet) {
  if (!book_) return false;
  if (t >= next_beacon_t_) {
    next_beacon_t_ = t + beacon_period;
    packet = beacon_packet(robot_, *book_);
    return true;
  }
  NewsBook::Letter letter;
  if (!book_->next_to_send(t, letter)) return false;
  packet = piece_packet(robot_, letter);
  return true;
}

void TeamFilter::hear(double t, std::span<const std::byte> packet) {
  if (!book_) return;
  const std::optional<Packet> heard = open_packet(packet, book_->robots());
  if (!heard || heard->from == robot_) return;
  if (heard->is_beacon) {
    for (std::size_t of = 0; of < heard->known.size(); ++of)
      book_->note(heard->from, of, heard->known[of], t);
    return;
  }
  std::optional<TeamPiece> piece = decode(heard->piece);
  if (!piece || !book_->add(heard->name, heard->piece, t)) return;
  piece->Omega.resize(0, 0);
  piece->r.resize(0);
  waiting_.emplace(heard->name, WaitingPiece{std::move(*piece), {heard->piece.begin(), heard->piece.end()}});
  ++counts_.heard_pieces;
}

std::size_t TeamFilter::memory_bytes() const {
  std::size_t bytes = FilterAround::memory_bytes() + (book_ ? book_->memory_bytes() : 0);
  for (const auto& [name, waiting] : waiting_)
    bytes += sizeof(waiting) + waiting.bytes.capacity() + waiting.outline.size() * sizeof(Eigen::Vector2d);
  return bytes;
}

}  // namespace seif
