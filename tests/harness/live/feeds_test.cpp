#include "harness/live/feeds.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <vector>

namespace harness {

namespace {

using Feed = ValueFeed<2>;
using Known = std::map<std::uint32_t, float>;

/// Takes up to `most` items, as a page does.
void read(const Feed& feed, Feed::Cursor& cursor, std::size_t most, Known& known) {
  std::vector<std::uint32_t> ids;
  std::vector<float> values;
  feed.collect(cursor, most, ids, values);
  ASSERT_LE(ids.size(), most);
  ASSERT_EQ(values.size(), 2 * ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) known[ids[i]] = values[2 * i];
}

}  // namespace

TEST(ValueFeed, GivesAllOnceAndThenWhatChanges) {
  Feed feed;
  for (std::uint32_t id = 0; id < 10; ++id) feed.put(id, {static_cast<float>(id), 0.0F});
  Feed::Cursor cursor;
  std::vector<std::uint32_t> ids;
  std::vector<float> values;
  feed.collect(cursor, 100, ids, values);
  EXPECT_EQ(ids.size(), 10U);
  feed.put(3, {30.0F, 0.0F});
  feed.put(4, {40.0F, 0.0F});
  feed.put(3, {31.0F, 0.0F});
  ids.clear();
  values.clear();
  feed.collect(cursor, 100, ids, values);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{4, 3}));
  EXPECT_EQ(values[2], 31.0F);
  ids.clear();
  feed.collect(cursor, 100, ids, values);
  EXPECT_TRUE(ids.empty());
}

TEST(ValueFeed, EveryReaderEndsWithTheLatestValuesHoweverSlowItIs) {
  Feed feed;
  Feed::Cursor fast, slow, late;
  Known by_fast, by_slow, by_late;
  Known truth;
  for (std::uint32_t round = 0; round < 200; ++round) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const std::uint32_t id = (round * 37 + i * 11) % 5000;
      const auto value = static_cast<float>(round * 1000 + i);
      feed.put(id, {value, 0.0F});
      truth[id] = value;
    }
    read(feed, fast, 2000, by_fast);
    if (round % 50 == 0) read(feed, slow, 700, by_slow);
  }
  for (int i = 0; i < 100; ++i) {
    read(feed, fast, 100, by_fast);
    read(feed, slow, 100, by_slow);
    read(feed, late, 100, by_late);
  }
  EXPECT_EQ(by_fast, truth);
  EXPECT_EQ(by_slow, truth);
  EXPECT_EQ(by_late, truth);
}

TEST(GrowingFeed, ANewReaderGetsTheWholeListAndThenWhatIsNew) {
  GrowingFeed<int> feed;
  for (int i = 0; i < 5; ++i) feed.add(i);
  GrowingFeed<int>::Cursor cursor;
  std::vector<int> values;
  EXPECT_TRUE(feed.collect(cursor, values));
  EXPECT_EQ(values, (std::vector<int>{0, 1, 2, 3, 4}));
  feed.add(5);
  EXPECT_FALSE(feed.collect(cursor, values));
  EXPECT_EQ(values, (std::vector<int>{5}));
}

TEST(GrowingFeed, StaysSmallAndCoversAllOfThePast) {
  GrowingFeed<int> feed;
  GrowingFeed<int>::Cursor behind;
  std::vector<int> values;
  feed.add(0);
  feed.collect(behind, values);
  for (int i = 1; i < 1'000'000; ++i) feed.add(i);
  EXPECT_TRUE(feed.collect(behind, values));  // it has missed too much
  EXPECT_LE(values.size(), 4001U);
  EXPECT_EQ(values.front(), 0);
  EXPECT_GT(values.back(), 990'000);
}

}  // namespace harness
