#include "harness/live/message.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "harness/web/page_client.hpp"

namespace harness {

TEST(WriteMessage, IsReadAsItWasWritten) {
  MessageArrays arrays;
  arrays.add("a", std::vector<float>{1.5F, -2.0F});
  arrays.add("b", std::vector<std::uint8_t>{1, 2, 3});
  arrays.add("c", std::vector<std::uint32_t>{7});
  arrays.add("none", std::vector<float>{});
  PageMessage message;
  write_message(R"({"kind":"test"})", arrays, message);
  EXPECT_EQ(message.size() % 4, 0U);
  const test::ReceivedMessage read = test::decoded(message);
  EXPECT_EQ(read.json.at("kind"), "test");
  EXPECT_EQ(read.floats("a"), (std::vector<float>{1.5F, -2.0F}));
  EXPECT_EQ(read.arrays.at("b"), (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(read.numbers("c"), (std::vector<std::uint32_t>{7}));
  EXPECT_TRUE(read.floats("none").empty());
  write_message("{}", {}, message);
  EXPECT_EQ(test::decoded(message).json.size(), 1U);
}

}  // namespace harness
