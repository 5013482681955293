// The next zone, and what has to be done for it.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include "seif/freezing.hpp"
#include "seif/tree/condensation_nodes.hpp"

namespace seif {

/// Pieces that keep their memory, so that no update allocates.
class FrozenPieces {
 public:
  void add(const FrozenPiece& piece) {
    if (count_ == pieces_.size()) pieces_.emplace_back();
    pieces_[count_++].copy(piece);
  }
  void clear() { count_ = 0; }
  std::span<const FrozenPiece> all() const { return std::span(pieces_).first(count_); }

 private:
  std::vector<FrozenPiece> pieces_;
  std::size_t count_ = 0;
};

/// A plan takes the map as it is when the plan begins, and holds for that: `planned` of all records.
struct CondensationPlan {
  bool is_running = false;
  int number = 0;               // of all plans so far
  std::vector<int> hot_leaves;  // of the next zone
  std::vector<int> path;        // of the next zone
  int top_ring = 0;             // of the next zone

  // What is to be done.
  std::vector<int> stale;     // nodes and rings that send anew
  std::vector<int> readings;  // the same, from the zone on: what was settled there is read
  std::vector<int> carried;   // hot leaves: their elements are taken where their landmarks are
  std::vector<int> order;  // the stale ones, each after those that it depends on: they send; the zone is last

  // How far it is done. [-]
  std::size_t read = 0, carried_so_far = 0, ready = 0;
  std::deque<SentMessage> messages;  // by `order`, as far as ready
  bool is_ready() const { return is_running && ready == order.size(); }

  // What has come since.
  FrozenPieces fresh;           // frozen, and not yet in the elements of leaves
  std::vector<int> new_leaves;  // that stand beside the tree
  int updates = 0;              // [-]
  bool is_urgent = false;       // a closure has bent the zone
  bool has_news = false;        // what others know
};

}  // namespace seif
