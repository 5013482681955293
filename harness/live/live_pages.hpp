// The open pages of a live run: what each has been told, and what it asks for. Works in the server's thread.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string_view>

#include "harness/live/exchange.hpp"
#include "harness/live/live_board.hpp"
#include "harness/live/outbox.hpp"
#include "harness/live/request.hpp"
#include "harness/live/snapshot.hpp"
#include "harness/live/view_wish.hpp"
#include "harness/web/page_server.hpp"

namespace harness {

/// All that the thread of a run and that of its pages have in common.
struct LiveChannels {
  Exchange<LiveSnapshot> snapshots;  // from the run
  Outbox outbox;                     // from the run
  ViewWish wish;                     // to the run
  RequestQueue requests;             // to the run
};

class LivePages final : public PageHandler {
 public:
  /// `channels` must outlive the pages.
  explicit LivePages(LiveChannels& channels) : channels_(channels) {}

  void tick() override;
  void opened(PageId page) override;
  void closed(PageId page) override;
  void received(PageId page, std::string_view text) override;
  bool next(PageId page, PageMessage& message) override;

 private:
  struct Page {
    BoardCursor cursor;
    asks::View view;
    std::deque<PageMessage> letters;
    double allowance = 0.0;  // [byte] that it may be sent now
  };

  void deliver(Page& page, const PageMessage& message);
  void tell_wish();

  LiveChannels& channels_;
  LiveBoard board_;
  std::map<PageId, Page> pages_;
};

}  // namespace harness
