#include "harness/web/page_server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "page_client.hpp"

namespace harness {

namespace {

using test::PageClient;

/// Counts up for each page, and writes down what it is told.
class CountingPages final : public PageHandler {
 public:
  explicit CountingPages(std::size_t size = 0) : size_(size) {}

  void opened(PageId page) override {
    const std::lock_guard lock(mutex_);
    open_.insert(page);
    ++opened_;
  }
  void closed(PageId page) override {
    const std::lock_guard lock(mutex_);
    open_.erase(page);
  }
  void received(PageId, std::string_view text) override {
    const std::lock_guard lock(mutex_);
    texts_.emplace_back(text);
  }
  bool next(PageId page, PageMessage& message) override {
    if (has_stopped_) return false;
    ++asked_;
    std::string json =
        "{\"kind\":\"count\",\"number\":" + std::to_string(counts_[page]++) + ",\"arrays\":[]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto length = static_cast<std::uint32_t>(json.size());
    message.resize(4);
    for (std::size_t i = 0; i < 4; ++i) message[i] = static_cast<std::uint8_t>(length >> (8U * i));
    message.insert(message.end(), json.begin(), json.end());
    message.resize(message.size() + size_);
    return true;
  }

  std::size_t open() {
    const std::lock_guard lock(mutex_);
    return open_.size();
  }
  std::size_t ever_opened() {
    const std::lock_guard lock(mutex_);
    return opened_;
  }
  std::vector<std::string> texts() {
    const std::lock_guard lock(mutex_);
    return texts_;
  }
  std::int64_t asked() const { return asked_; }
  void stop() { has_stopped_ = true; }

 private:
  std::size_t size_;  // [byte] more in each message
  std::mutex mutex_;
  std::set<PageId> open_;
  std::size_t opened_ = 0;
  std::vector<std::string> texts_;
  std::map<PageId, int> counts_;
  std::atomic<std::int64_t> asked_ = 0;
  std::atomic<bool> has_stopped_ = false;
};

std::string socket_of(const PageServer& server) { return "/socket?token=" + server.token(); }

/// Waits, as long as a busy machine needs.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 6000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

PageServerPlan plan_with(std::string html) {
  PageServerPlan plan;
  plan.html = std::move(html);
  return plan;
}

}  // namespace

TEST(PageServer, ServesThePageWithAPolicyThatForbidsOtherSources) {
  CountingPages pages;
  const PageServer server(plan_with("<p>hello</p>"), pages);
  const test::HttpAnswer answer = test::http_get(server.port(), "/?token=" + server.token());
  EXPECT_EQ(answer.status, 200U);
  EXPECT_EQ(answer.body, "<p>hello</p>");
  EXPECT_NE(answer.headers.at("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(server.url(), "http://127.0.0.1:" + std::to_string(server.port()) + "/?token=" + server.token());
}

TEST(PageServer, RefusesWrongTokensMethodsPathsAndOrigins) {
  CountingPages pages;
  const PageServer server(plan_with("x"), pages);
  EXPECT_EQ(test::http_get(server.port(), "/").status, 403U);
  EXPECT_EQ(test::http_get(server.port(), "/a?token=" + server.token()).status, 404U);
  EXPECT_EQ(test::http_get(server.port(), "/?token=" + server.token(), {}, "DELETE").status, 405U);
  EXPECT_THROW(PageClient(server.port(), "/socket?token=0"), std::runtime_error);
  EXPECT_THROW(PageClient(server.port(), socket_of(server), {{"Origin", "http://evil.example"}}),
               std::runtime_error);
  EXPECT_EQ(pages.ever_opened(), 0U);
}

TEST(PageServer, SendsToEachPageAndPassesOnWhatItSays) {
  CountingPages pages;
  const PageServer server(plan_with("x"), pages);
  PageClient first(server.port(), socket_of(server));
  PageClient second(server.port(), socket_of(server));
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(first.receive()->json.at("number"), i);
    EXPECT_EQ(second.receive()->json.at("number"), i);
  }
  first.send("one");
  second.send("two");
  ASSERT_TRUE(comes_true([&] { return pages.texts().size() == 2; }));
  EXPECT_EQ(pages.open(), 2U);
}

TEST(PageServer, ForgetsPagesThatVanish) {
  CountingPages pages;
  const PageServer server(plan_with("x"), pages);
  for (int i = 0; i < 20; ++i) {
    PageClient page(server.port(), socket_of(server));
    page.receive();
    if (i % 2 == 0) page.drop();
  }
  EXPECT_TRUE(comes_true([&] { return pages.open() == 0; }));
  EXPECT_EQ(pages.ever_opened(), 20U);
}

TEST(PageServer, ClosesAPageThatSendsTooMuchOrTooFast) {
  CountingPages pages;
  const PageServer server(plan_with("x"), pages);
  PageClient large(server.port(), socket_of(server));
  large.receive();
  large.send(std::string(10'000, 'x'));
  EXPECT_TRUE(comes_true([&] { return pages.open() == 0; }));
  PageClient fast(server.port(), socket_of(server));
  fast.receive();
  for (int i = 0; i < 5000; ++i) fast.send("x");
  EXPECT_TRUE(comes_true([&] { return pages.open() == 0; }));
  EXPECT_LT(pages.texts().size(), 5000U);
}

/// A page that never reads gets what fits into the buffers of the system, and then nothing is made for it.
TEST(PageServer, AsksNothingForAPageThatDoesNotRead) {
  CountingPages pages(1'000'000);
  const PageServer server(plan_with("x"), pages);
  const PageClient lazy(server.port(), socket_of(server));
  ASSERT_TRUE(comes_true([&] { return pages.asked() > 0; }));
  std::int64_t before = -1;
  EXPECT_TRUE(comes_true([&] {
    const bool is_same = pages.asked() == before;
    before = pages.asked();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return is_same;
  }));
  EXPECT_LT(pages.asked(), 1000);
}

TEST(PageServer, RefusesMorePagesThanItMayHave) {
  CountingPages pages;
  PageServerPlan plan = plan_with("x");
  plan.most_pages = 3;
  const PageServer server(std::move(plan), pages);
  std::vector<PageClient> open;
  for (int i = 0; i < 3; ++i) {
    open.emplace_back(server.port(), socket_of(server));
    open.back().receive();
  }
  EXPECT_THROW(PageClient(server.port(), socket_of(server)), std::exception);
}

TEST(PageServer, SaysWhichAddressItCannotUse) {
  CountingPages pages;
  PageServerPlan plan = plan_with("x");
  plan.address = "203.0.113.7";
  EXPECT_THROW(PageServer(std::move(plan), pages), std::system_error);
}

}  // namespace harness
