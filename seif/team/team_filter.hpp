// `multi_seif`: a Seif whose robot tells others what it has learnt, and learns from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "seif/association/filter_around.hpp"
#include "seif/seif.hpp"
#include "seif/team/news_book.hpp"
#include "seif/team/piece_sum.hpp"
#include "seif/team/team_member.hpp"

namespace seif {

struct TeamOptions {
  int tell_after = 50;    // [-] updates after which what was frozen is told
  int most_told = 32;     // [-] landmarks of what is told at once
  int listen_after = 40;  // [-] updates between two additions of what was heard
  int most_learnt = 512;  // [-] landmarks of what is added at once
};

/// Each robot has a filter of its own, in the frame of its own start. What the filter freezes is told, each piece once;
/// what others have frozen is added to the map as soon as landmarks of it are known there. So the information of all
/// robots adds up in each map, and no measurement counts twice, whichever way its piece has come (Thrun and Liu,
/// "Multi-Robot SLAM With Sparse Extended Information Filters", 2003, have the sum; here it is made piece by piece).
/// What is still in the window of another robot is missing.
class TeamFilter final : public FilterAround, public TeamMember {
 public:
  TeamFilter(std::unique_ptr<Seif> filter, const TeamOptions& options);
  TeamFilter(const TeamFilter&) = delete;  // its filter calls it
  TeamFilter& operator=(const TeamFilter&) = delete;

  void measurement_update(const Scan& scan, const StageDone& done) override;
  std::size_t memory_bytes() const override;
  TeamMember* team_member() override { return this; }

  void enter_team(std::size_t robot, std::size_t robots) override;
  bool speak(double t, std::vector<std::byte>& packet) override;
  void hear(double t, std::span<const std::byte> packet) override;
  TeamCounts team_counts() const override { return counts_; }

  const TreeNews& news() const { return *seif_.news(); }

 private:
  struct WaitingPiece {
    TeamPiece outline;  // without its numbers, to save memory
    std::vector<std::byte> bytes;
  };

  void note(const FrozenPiece& piece);
  void tell();
  void learn(double t);
  void learn(const PieceName& name, std::span<const std::byte> bytes, double t);

  Seif& seif_;
  TeamOptions options_;
  std::optional<NewsBook> book_;  // in a team
  std::size_t robot_ = 0;
  PieceSum sum_;
  std::map<PieceName, WaitingPiece> waiting_;  // heard, and not yet in the map
  PieceName looked_at_;                        // the last one of these
  int untold_updates_ = 0, deaf_updates_ = 0;
  double next_beacon_t_ = 0.0;  // [s]
  TeamCounts counts_;
};

}  // namespace seif
