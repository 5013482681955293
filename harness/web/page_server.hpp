// A small web server for one page: it serves the page, and talks to every open copy of it over a WebSocket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace harness {

/// A number for each page that was opened; none is used twice.
using PageId = std::uint64_t;

/// A binary message to a page.
using PageMessage = std::vector<std::uint8_t>;

/// What the server asks and tells. All calls come from the server's thread.
class PageHandler {
 public:
  virtual ~PageHandler() = default;

  /// Before the pages are asked for their next messages, `ticks_per_second` times a second.
  virtual void tick() {}
  virtual void opened(PageId page) = 0;
  virtual void closed(PageId page) = 0;
  /// A text from a page, at most `PageServerPlan::longest_text` bytes. It may hold anything.
  virtual void received(PageId page, std::string_view text) = 0;
  /// Overwrites `message` with the next message for this page; false if there is none. It is asked only when
  /// the page has taken what was sent before: a slow page misses messages, and nothing waits for it.
  virtual bool next(PageId page, PageMessage& message) = 0;
};

struct PageServerPlan {
  std::string address = "127.0.0.1";  // of this machine; other machines reach "0.0.0.0" and "::"
  std::uint16_t port = 0;             // 0: any free one
  std::string html;                   // the page
  std::size_t longest_text = 4096;    // [byte] of a message from a page; a longer one closes its connection
  int texts_per_second = 200;         // [1/s] more close the connection
  int most_pages = 64;                // [-] connections at once; more are refused
  int ticks_per_second = 30;          // [1/s]
};

/// Whoever opens the page must know a token, which is random and part of url(). Requests of other origins are
/// refused. A page that does not answer is closed after half a minute.
class PageServer {
 public:
  /// Listens, and starts a thread. Throws std::system_error if the address or the port cannot be used. `handler`
  /// must outlive the server.
  PageServer(PageServerPlan plan, PageHandler& handler);
  /// Closes all pages, and ends the thread.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// The address to open in a browser on this machine.
  const std::string& url() const { return url_; }
  std::uint16_t port() const;
  const std::string& token() const;

 private:
  class Core;

  std::unique_ptr<Core> core_;
  std::string url_;
};

}  // namespace harness
