// What an estimator hears is in its file at once, whole.
#include "harness/run/heard_packets.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "harness/fixtures.hpp"

namespace harness {
namespace {

struct SilentMember final : seif::TeamMember {
  void enter_team(std::size_t, std::size_t) override {}
  bool speak(double, std::vector<std::byte>&) override { return false; }
  void hear(double, std::span<const std::byte> packet) override { heard += packet.size(); }
  seif::TeamCounts team_counts() const override { return {}; }

  std::size_t heard = 0;  // [byte]
};

TEST(HeardPackets, AreWrittenWhenTheyAreHeard) {
  const TemporaryFolder folder;
  SilentMember member;
  HeardPackets heard(member, heard_file(folder.path(), "mine"));
  heard.enter_team(1, 3);
  heard.hear(0.5, std::vector<std::byte>{std::byte{0x0f}, std::byte{0xa0}});
  heard.hear(0.75, {});
  EXPECT_EQ(test::read_file(folder / "mine_heard.csv"),
            "t,robot,robots,more,packet\n0.5,1,3,0,0fa0\n0.75,1,3,0,\n");
  EXPECT_EQ(member.heard, 2U);
}

TEST(HeardPackets, ThatAreLongTakeSeveralRows) {
  const TemporaryFolder folder;
  SilentMember member;
  HeardPackets heard(member, heard_file(folder.path(), "mine"));
  heard.enter_team(0, 2);
  heard.hear(1.0, std::vector<std::byte>(3200));
  const std::string text = test::read_file(folder / "mine_heard.csv");
  EXPECT_NE(text.find("\n1,0,2,1," + std::string(3000, '0') + "\n1,0,2,1,"), std::string::npos);
  EXPECT_TRUE(text.ends_with("\n1,0,2,0," + std::string(400, '0') + "\n"));
}

}  // namespace
}  // namespace harness
