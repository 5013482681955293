// What a robot has heard and told: the coded pieces of all robots, and which of them the others have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

namespace seif {

inline constexpr std::size_t most_robots = 64;  // [-] of a team

/// The number of pieces of one robot that somebody has, without a gap, and which of the next ones: bit k is piece
/// next + 1 + k.
struct KnownPieces {
  std::uint32_t next = 0;
  std::uint32_t later = 0;

  bool has(std::uint32_t number) const;
  friend bool operator==(const KnownPieces&, const KnownPieces&) = default;
};

/// A piece of the team: the number among those of a robot.
struct PieceName {
  std::size_t robot = 0;
  std::uint32_t number = 0;
  friend auto operator<=>(const PieceName&, const PieceName&) = default;
};

/// A piece is forgotten once all robots have it.
class NewsBook {
 public:
  NewsBook(std::size_t robot, std::size_t robots);

  std::size_t robots() const { return of_.size(); }

  /// Enters the next piece of this robot itself.
  void add_own(std::vector<std::byte> piece);
  /// Enters a piece that was heard at time t [s]; those near have probably heard it, too. False if it was known, or if it
  /// is too far ahead of those that are known.
  bool add(const PieceName& name, std::span<const std::byte> piece, double t);

  KnownPieces known(std::size_t of) const;
  /// What another robot has of a third one's pieces, as it has said itself at time t [s].
  void note(std::size_t robot, std::size_t of, const KnownPieces& known, double t);

  /// A piece that a robot which was heard of lately lacks, and that was not sent since. Null if there is none.
  struct Letter {
    PieceName name;
    std::span<const std::byte> piece;
  };
  bool next_to_send(double t, Letter& letter);

  std::size_t memory_bytes() const;

 private:
  struct Entry {
    std::vector<std::byte> piece;
    double sent_t;  // [s] when it was last on the air
  };
  /// The pieces of one robot.
  struct Chapter {
    std::uint32_t first = 0;               // number of the first one that is kept
    std::deque<Entry> entries;             // without a gap
    std::map<std::uint32_t, Entry> later;  // after a gap
    std::vector<KnownPieces> known;        // by the other robots
    std::uint32_t next() const { return first + static_cast<std::uint32_t>(entries.size()); }
  };

  Entry* find(const PieceName& name);
  void prune(Chapter& chapter);

  std::size_t robot_;
  std::vector<Chapter> of_;
  std::vector<double> heard_t_;  // [s] of each robot
};

}  // namespace seif
