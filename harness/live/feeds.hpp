// Values that many pages follow, each at its own pace, in bounded memory and work.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "harness/live/running_figures.hpp"

namespace harness {

/// The latest values of many things by id. A reader gets all of them once, and then those that have changed; if it
/// has missed too many changes, all of them again.
template <std::size_t width>
class ValueFeed {
 public:
  struct Cursor {
    std::size_t next = 0;      // [-] of the items, while it gets all of them
    std::uint64_t change = 0;  // [-] the change that it gets next
    bool is_new = true;
  };

  void put(std::uint32_t id, const std::array<float, width>& value) {
    const auto [number, is_first] = numbers_.try_emplace(id, items_.size());
    if (is_first) items_.emplace_back();
    items_[number->second] = {id, value, changes_};
    if (log_.size() < most_changes) log_.resize(most_changes);
    log_[changes_++ % most_changes] = number->second;
  }

  /// Appends up to `most` items.
  void collect(Cursor& cursor, std::size_t most, std::vector<std::uint32_t>& ids,
               std::vector<float>& values) const {
    if (cursor.is_new || changes_ - cursor.change > most_changes) cursor = {0, changes_, false};
    const auto append = [&](const Item& item) {
      ids.push_back(item.id);
      values.insert(values.end(), item.value.begin(), item.value.end());
      --most;
    };
    while (most > 0 && cursor.next < items_.size()) append(items_[cursor.next++]);
    for (; most > 0 && cursor.change < changes_; ++cursor.change) {
      const Item& item = items_[log_[cursor.change % most_changes]];
      if (item.change == cursor.change) append(item);  // otherwise a later change follows
    }
  }

 private:
  static constexpr std::size_t most_changes = 1U << 15U;  // [-]

  struct Item {
    std::uint32_t id = 0;
    std::array<float, width> value = {};
    std::uint64_t change = 0;  // [-] the latest of it
  };

  std::vector<Item> items_;
  std::unordered_map<std::uint32_t, std::size_t> numbers_;
  std::vector<std::size_t> log_;  // a ring: the item of each change
  std::uint64_t changes_ = 0;     // [-] so far
};

/// A list that only grows: coarser in its older part, so that its memory is bounded.
template <class Value>
class GrowingFeed {
 public:
  struct Cursor {
    std::uint64_t next = 0;
    bool is_new = true;
  };

  void add(const Value& value) {
    if (whole_.size() >= most_kept) halve(whole_);
    whole_.push_back(value);
    if (recent_.size() < most_recent) recent_.resize(most_recent);
    recent_[count_++ % most_recent] = value;
  }

  /// Overwrites `out`: with the whole list for a reader that is new or has missed something, and otherwise with what
  /// is new. True: it is the whole list.
  bool collect(Cursor& cursor, std::vector<Value>& out) const {
    out.clear();
    const bool is_whole = cursor.is_new || count_ - cursor.next > most_recent;
    if (is_whole) {
      out = whole_;
    } else {
      for (std::uint64_t i = cursor.next; i < count_; ++i) out.push_back(recent_[i % most_recent]);
    }
    cursor = {count_, false};
    return is_whole;
  }

 private:
  static constexpr std::size_t most_kept = 4000;    // [-]
  static constexpr std::size_t most_recent = 4096;  // [-]

  std::vector<Value> whole_;
  std::vector<Value> recent_;  // a ring
  std::uint64_t count_ = 0;    // [-] so far
};

}  // namespace harness
