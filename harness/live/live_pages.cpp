#include "harness/live/live_pages.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

constexpr std::size_t most_letters = 64;        // [-] that wait for a page; the oldest go first
constexpr double bytes_at_once = 8e6;           // [byte] for the first picture of a large world
constexpr double bytes_for_each_tick = 60'000;  // [byte] 1.8 MB/s at 30 ticks a second

}  // namespace

void LivePages::tick() {
  if (auto setting = channels_.outbox.take_setting()) board_.set(std::move(setting));
  if (const LiveSnapshot* snapshot = channels_.snapshots.to_read()) {
    board_.take(*snapshot);
    channels_.snapshots.give_back();
  }
  for (Letter& letter : channels_.outbox.take_letters()) {
    for (auto& [id, page] : pages_) {
      if (!letter.to || *letter.to == id) deliver(page, letter.message);
    }
  }
  for (auto& [id, page] : pages_)
    page.allowance = std::min(page.allowance + bytes_for_each_tick, bytes_at_once);
}

void LivePages::deliver(Page& page, const PageMessage& message) {
  if (page.letters.size() >= most_letters) page.letters.pop_front();
  page.letters.push_back(message);
}

void LivePages::opened(PageId page) {
  pages_[page].allowance = bytes_at_once;
  tell_wish();
}

void LivePages::closed(PageId page) {
  pages_.erase(page);
  tell_wish();
}

void LivePages::received(PageId id, std::string_view text) {
  const auto page = pages_.find(id);
  if (page == pages_.end()) return;
  try {
    Request request = read_request(text);
    request.page = id;
    if (const auto* view = std::get_if<asks::View>(&request.ask)) {
      page->second.view = *view;
      tell_wish();
      return;
    }
    const std::int64_t seq = request.seq;
    if (!channels_.requests.push(std::move(request)))
      deliver(page->second, said(true, "too many requests are waiting", seq));
  } catch (const BadInput& error) {
    deliver(page->second, said(true, error.what(), 0));
  }
}

bool LivePages::next(PageId id, PageMessage& message) {
  Page& page = pages_.at(id);
  if (page.allowance <= 0.0) return false;
  if (!page.letters.empty()) {
    message = std::move(page.letters.front());
    page.letters.pop_front();
  } else if (!board_.next(page.cursor, page.view.matrix, static_cast<int>(pages_.size()), message)) {
    return false;
  }
  page.allowance -= static_cast<double>(message.size());
  return true;
}

/// The ground that any page shows.
void LivePages::tell_wish() {
  LiveView wish;
  for (const auto& [id, page] : pages_) {
    const Area area{page.view.min.cwiseMin(page.view.max), page.view.min.cwiseMax(page.view.max)};
    if (wish.pages++ == 0) wish.area = area;
    wish.area = {wish.area.min.cwiseMin(area.min), wish.area.max.cwiseMax(area.max)};
    wish.matrix = wish.matrix || page.view.matrix;
    wish.links = wish.links || page.view.links;
  }
  channels_.wish.set(wish);
}

}  // namespace harness
