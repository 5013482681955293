#include "seif/team/news_book.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace seif {
namespace {

constexpr std::uint32_t most_ahead = 32;                            // [-] pieces after a gap
constexpr double never = -std::numeric_limits<double>::infinity();  // [s]
constexpr double lately = 3.0;                                      // [s] whom one hears from is near
constexpr double patience = 0.5;  // [s] until a piece that was sent counts as lost

}  // namespace

bool KnownPieces::has(std::uint32_t number) const {
  if (number < next) return true;
  return number > next && number - next <= most_ahead && (later >> (number - next - 1) & 1U) != 0;
}

NewsBook::NewsBook(std::size_t robot, std::size_t robots)
    : robot_(robot), of_(robots), heard_t_(robots, never) {
  for (Chapter& chapter : of_) chapter.known.resize(robots);
}

void NewsBook::add_own(std::vector<std::byte> piece) {
  of_[robot_].entries.push_back({std::move(piece), never});
}

bool NewsBook::add(const PieceName& name, std::span<const std::byte> piece, double t) {
  if (Entry* const entry = find(name)) entry->sent_t = t;
  Chapter& chapter = of_[name.robot];
  const std::uint32_t next = chapter.next();
  if (name.robot == robot_ || name.number < next || name.number - next > most_ahead) return false;
  if (!chapter.later.try_emplace(name.number, Entry{{piece.begin(), piece.end()}, t}).second) return false;
  for (auto first = chapter.later.begin(); first != chapter.later.end() && first->first == chapter.next();
       first = chapter.later.erase(first))
    chapter.entries.push_back(std::move(first->second));
  return true;
}

KnownPieces NewsBook::known(std::size_t of) const {
  const Chapter& chapter = of_[of];
  KnownPieces known{.next = chapter.next()};
  for (const auto& [number, entry] : chapter.later) known.later |= 1U << (number - known.next - 1);
  return known;
}

void NewsBook::note(std::size_t robot, std::size_t of, const KnownPieces& known, double t) {
  heard_t_[robot] = t;
  KnownPieces& before = of_[of].known[robot];
  if (known.next < before.next) return;  // an old message
  before = known;
  prune(of_[of]);
}

/// Of its first pieces, those that all other robots have.
void NewsBook::prune(Chapter& chapter) {
  std::uint32_t all = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t robot = 0; robot < of_.size(); ++robot) {
    if (robot != robot_) all = std::min(all, chapter.known[robot].next);
  }
  for (; chapter.first < all && !chapter.entries.empty(); ++chapter.first) chapter.entries.pop_front();
}

NewsBook::Entry* NewsBook::find(const PieceName& name) {
  Chapter& chapter = of_[name.robot];
  if (name.number < chapter.first) return nullptr;
  const std::size_t index = name.number - chapter.first;
  return index < chapter.entries.size() ? &chapter.entries[index] : nullptr;
}

bool NewsBook::next_to_send(double t, Letter& letter) {
  for (std::size_t to = 0; to < of_.size(); ++to) {
    if (heard_t_[to] < t - lately) continue;
    for (std::size_t of = 0; of < of_.size(); ++of) {
      const KnownPieces& has = of_[of].known[to];
      const std::uint32_t end = std::min(known(of).next, has.next + most_ahead + 1);
      for (std::uint32_t number = has.next; of != to && number < end; ++number) {
        Entry* entry = find({of, number});
        if (entry == nullptr || has.has(number) || entry->sent_t > heard_t_[to] - patience) continue;
        entry->sent_t = t;
        letter = {{of, number}, entry->piece};
        return true;
      }
    }
  }
  return false;
}

std::size_t NewsBook::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Chapter& chapter : of_) {
    for (const Entry& entry : chapter.entries) bytes += sizeof(entry) + entry.piece.capacity();
    for (const auto& [number, entry] : chapter.later) bytes += sizeof(entry) + entry.piece.capacity();
  }
  return bytes;
}

}  // namespace seif
