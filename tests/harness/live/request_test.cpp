#include "harness/live/request.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <variant>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(read_request(text));
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(ReadRequest, ReadsEachKind) {
  const Request request = read_request(R"({"do":"kidnap","x":1.5,"y":-2,"heading_deg":90,"seq":7})");
  EXPECT_EQ(request.seq, 7);
  const auto& kidnap = std::get<asks::Kidnap>(request.ask);
  EXPECT_EQ(kidnap.x, 1.5);
  EXPECT_EQ(kidnap.heading_deg, 90.0);
  EXPECT_TRUE(std::holds_alternative<asks::Stage>(read_request(R"({"do":"stage"})").ask));
  EXPECT_TRUE(std::isinf(std::get<asks::Speed>(read_request(R"({"do":"speed","value":"max"})").ask).factor));
  const auto beside = std::get<asks::Beside>(
      read_request(R"({"do":"beside","estimator":"seif","option":"mean_recovery","value":"exact"})").ask);
  EXPECT_EQ(std::get<std::string>(beside.value), "exact");
  EXPECT_EQ(std::get<asks::Wall>(read_request(R"({"do":"wall","points":[[0,0],[1,1]]})").ask).points.size(),
            2U);
}

TEST(ReadRequest, SaysWhatIsWrong) {
  EXPECT_EQ(complaint("nonsense"), "a request must be a JSON object");
  EXPECT_EQ(complaint(R"({"do":"fly"})"), "'do' is unknown: fly");
  EXPECT_EQ(complaint(R"({"do":"back"})"), "'t' is missing");
  EXPECT_EQ(complaint(R"({"do":"back","t":"soon"})"), "'t' must be a number of at most 1e6");
  EXPECT_EQ(complaint(R"({"do":"back","t":1e9})"), "'t' must be a number of at most 1e6");
  EXPECT_EQ(complaint(R"({"do":"speed","value":0})"), "'value' must be from 0.01 to 10000, or \"max\"");
  EXPECT_EQ(complaint(R"({"do":"silence","sensor":"nose","on":true})"),
            "'sensor' must be landmark_sensor or encoders");
  EXPECT_EQ(complaint(R"({"do":"save","what":"/etc/passwd"})"), "'what' must be run, film or report");
  EXPECT_EQ(complaint(R"({"do":"wall","points":[[0,0]]})"), "'points' must be a list of points");
}

TEST(RequestQueue, IsBoundedAndKeepsTheOrder) {
  RequestQueue queue;
  int accepted = 0;
  for (int i = 0; i < 1000; ++i) accepted += queue.push({0, i, asks::Pause{}}) ? 1 : 0;
  EXPECT_EQ(accepted, 256);
  for (int i = 0; i < accepted; ++i) EXPECT_EQ(queue.pop()->seq, i);
  EXPECT_FALSE(queue.pop());
}

TEST(RequestQueue, WakesWhoWaits) {
  RequestQueue queue;
  std::thread other([&] { static_cast<void>(queue.push({0, 1, asks::Go{}})); });
  queue.wait_until(std::chrono::steady_clock::now() + std::chrono::hours(1));
  other.join();
  EXPECT_TRUE(queue.pop());
}

}  // namespace harness
