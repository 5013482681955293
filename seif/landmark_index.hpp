// Finds the slot of a landmark id. A slot is a landmark's number in the order in which it joined the map. A
// search takes two table look-ups. The table never rehashes, so no insertion costs a pass over the map. A page
// of the table exists only where there are ids.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "seif/types.hpp"

namespace seif {

class LandmarkIndex {
 public:
  /// The slot of a landmark, or nothing if it is not in the map.
  std::optional<int> find(LandmarkId landmark) const {
    assert(landmark >= 0);
    const std::size_t page = page_of(landmark);
    if (page >= pages_.size() || !pages_[page]) return std::nullopt;
    const int slot = (*pages_[page])[place_of(landmark)];
    return slot == empty ? std::nullopt : std::optional(slot);
  }

  void insert(LandmarkId landmark, int slot) {
    assert(!find(landmark) && slot >= 0);
    const std::size_t page = page_of(landmark);
    if (page >= pages_.size()) pages_.resize(page + 1);
    if (!pages_[page]) {
      pages_[page] = std::make_unique<Page>();
      pages_[page]->fill(empty);
      ++pages_used_;
    }
    (*pages_[page])[place_of(landmark)] = slot;
  }

  std::size_t memory_bytes() const {
    return pages_.capacity() * sizeof(pages_[0]) + pages_used_ * sizeof(Page);
  }

 private:
  static constexpr int empty = -1;
  static constexpr std::size_t page_size = 1024;
  using Page = std::array<int, page_size>;

  static std::size_t page_of(LandmarkId landmark) { return static_cast<std::size_t>(landmark) / page_size; }
  static std::size_t place_of(LandmarkId landmark) { return static_cast<std::size_t>(landmark) % page_size; }

  std::vector<std::unique_ptr<Page>> pages_;
  std::size_t pages_used_ = 0;
};

}  // namespace seif
