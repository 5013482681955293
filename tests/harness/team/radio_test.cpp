// What the radio carries, to whom, and when.
#include "harness/team/radio.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace harness {
namespace {

constexpr std::size_t packet_size = 100;

/// Says one thing at each exchange, and notes what it hears.
struct Chatterbox final : seif::TeamMember {
  void enter_team(std::size_t robot, std::size_t robots) override {
    number = robot;
    of = robots;
  }
  bool speak(double t, std::vector<std::byte>& packet) override {
    if (t == spoke_t) return false;
    spoke_t = t;
    packet.assign(packet_size, static_cast<std::byte>(number));
    return true;
  }
  void hear(double t, std::span<const std::byte> packet) override {
    heard_t.push_back(t);
    heard_sizes.push_back(packet.size());
  }
  seif::TeamCounts team_counts() const override { return {}; }

  std::size_t number = 99, of = 0;
  double spoke_t = -1.0;
  std::vector<double> heard_t;
  std::vector<std::size_t> heard_sizes;
};

class RadioTest : public testing::Test {
 protected:
  Radio make(const worlds::Radio& how) { return {how, {&a_, &b_, &c_}, std::mt19937_64(1)}; }
  /// Exchanges each tenth of a second.
  void run(Radio& radio, int times) const {
    for (int k = 0; k < times; ++k) radio.exchange(0.1 * k, at_);
  }

  Chatterbox a_, b_, c_;
  std::vector<Eigen::Vector2d> at_ = {{0, 0}, {10, 0}, {25, 0}};  // [m]
};

TEST_F(RadioTest, ReachesWhoIsInRangeAndNobodyElse) {
  Radio radio = make({.range = 12, .delay = 0});
  run(radio, 10);
  EXPECT_EQ(a_.number, 0U);
  EXPECT_EQ(c_.number, 2U);
  EXPECT_EQ(c_.of, 3U);
  EXPECT_EQ(a_.heard_t.size(), 9U);  // what is said is heard at the next exchange
  EXPECT_EQ(b_.heard_t.size(), 9U);
  EXPECT_TRUE(c_.heard_t.empty());
  EXPECT_EQ(radio.sent_bytes(2), static_cast<std::int64_t>(10 * packet_size));
}

TEST_F(RadioTest, ComesLate) {
  Radio radio = make({.range = 100, .delay = 0.55});
  run(radio, 10);
  EXPECT_EQ(a_.heard_t.front(), 0.1 * 6);
  EXPECT_EQ(a_.heard_t.size(), 2U * 4U);
}

TEST_F(RadioTest, LosesAndCutsOffItsShare) {
  Radio radio = make({.range = 100, .loss = 0.3, .cut_off = 0.5, .delay = 0});
  run(radio, 10'001);
  const double heard = static_cast<double>(a_.heard_sizes.size());
  EXPECT_NEAR(heard, 0.7 * 20'000, 400);
  std::size_t whole = 0;
  for (const std::size_t size : a_.heard_sizes) whole += size == packet_size ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(whole), 0.5 * heard, 400);
}

TEST_F(RadioTest, SendsNoMoreThanItsRate) {
  Radio radio = make({.range = 100, .delay = 0, .rate = 250});
  run(radio, 101);  // 10 s
  // A packet takes 0.4 s; the next one waits for the next exchange.
  EXPECT_LE(radio.sent_bytes(0), 26 * static_cast<std::int64_t>(packet_size));
  EXPECT_GE(radio.sent_bytes(0), 20 * static_cast<std::int64_t>(packet_size));
}

TEST_F(RadioTest, IsSilentWhereTheEstimatorHasFailed) {
  Radio radio = make({.range = 100, .delay = 0.1});
  run(radio, 1);
  radio.silence(1);
  run(radio, 10);
  EXPECT_TRUE(b_.heard_t.empty());
  EXPECT_EQ(radio.sent_bytes(1), static_cast<std::int64_t>(packet_size));
}

}  // namespace
}  // namespace harness
