// Items by hash, in a table that grows by one list at a time (Litwin, "Linear hashing", VLDB 1980), so no item that is
// added costs a pass over the others.
#pragma once

#include <cstddef>
#include <cstdint>

#include "seif/chunked_array.hpp"

namespace seif {

/// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014: its mixing function.
inline std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

class HashedLists {
 public:
  HashedLists() { lists_.push_back(none); }

  std::size_t size() const { return items_.size(); }
  /// The next item: 0, 1, 2, ..
  void add(std::uint64_t hash) {
    items_.push_back({.hash = hash});
    put_in(static_cast<int>(items_.size()) - 1);
    if (items_.size() > items_per_list * lists_.size()) split();
  }
  bool is_in(int i) const { return item(i).is_in; }
  void remove(int i) {
    if (is_in(i)) take_out(i);
  }
  void move(int i, std::uint64_t hash) {
    take_out(i);
    item(i).hash = hash;
    put_in(i);
  }
  /// Calls visit(item) for each item with this hash.
  template <class Visit>
  void for_each(std::uint64_t hash, Visit&& visit) const {
    for (int i = lists_[list_of(hash)]; i != none; i = item(i).next) {
      if (item(i).hash == hash) visit(i);
    }
  }
  std::size_t memory_bytes() const { return lists_.memory_bytes() + items_.memory_bytes(); }

 private:
  static constexpr int none = -1;
  static constexpr std::size_t items_per_list = 2;  // [-] in the mean
  struct Item {
    std::uint64_t hash = 0;
    int next = none;  // in its list
    bool is_in = false;
  };

  Item& item(int i) { return items_[static_cast<std::size_t>(i)]; }
  const Item& item(int i) const { return items_[static_cast<std::size_t>(i)]; }

  /// Lists below next_split_ have been split in this round, so one more bit of the hash counts.
  std::size_t list_of(std::uint64_t hash) const {
    const std::size_t list = hash & (round_ - 1);
    return list < next_split_ ? hash & (2 * round_ - 1) : list;
  }
  void put_in(int i) {
    int& head = lists_[list_of(item(i).hash)];
    item(i).next = head;
    item(i).is_in = true;
    head = i;
  }
  void take_out(int i) {
    int* link = &lists_[list_of(item(i).hash)];
    while (*link != i) link = &item(*link).next;
    *link = item(i).next;
    item(i).is_in = false;
  }
  void split() {
    int i = lists_[next_split_];
    lists_[next_split_] = none;
    lists_.push_back(none);
    if (++next_split_ == round_) {
      round_ *= 2;
      next_split_ = 0;
    }
    while (i != none) {
      const int next = item(i).next;
      put_in(i);
      i = next;
    }
  }

  std::size_t round_ = 1;       // lists at the beginning of this round of splitting, a power of two
  std::size_t next_split_ = 0;  // [-] of these
  ChunkedArray<int> lists_;     // heads
  ChunkedArray<Item> items_;
};

}  // namespace seif
