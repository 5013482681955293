// Who has which piece, and what is sent to whom, whatever the radio loses.
#include "seif/team/news_book.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "seif/team/packet.hpp"

namespace seif {
namespace {

using Bytes = std::vector<std::byte>;

Bytes content(std::size_t robot, int number) {
  return {static_cast<std::byte>(robot), static_cast<std::byte>(number), std::byte{7}};
}

/// Robots that exchange all that they have, through a radio that may lose, cut off, repeat or swap packets.
class Talk {
 public:
  explicit Talk(std::size_t robots) {
    for (std::size_t i = 0; i < robots; ++i) books.emplace_back(i, robots);
  }

  /// Ten seconds: beacons each second, letters each tenth. `carry` says what becomes of a packet.
  void go_on(const std::function<void(std::size_t from, std::size_t to, Bytes)>& carry) {
    for (int k = 0; k < 100; ++k) {
      t += 0.1;
      for (std::size_t from = 0; from < books.size(); ++from) {
        NewsBook::Letter letter;
        Bytes packet;
        if (k % 10 == 0) {
          packet = beacon_packet(from, books[from]);
        } else if (books[from].next_to_send(t, letter)) {
          packet = piece_packet(from, letter);
          ++letters;
        } else {
          continue;
        }
        for (std::size_t to = 0; to < books.size(); ++to) {
          if (to != from) carry(from, to, packet);
        }
      }
    }
  }

  void hear(std::size_t to, const Bytes& bytes) {
    const std::optional<Packet> packet = open_packet(bytes, books.size());
    if (!packet) return;
    if (packet->is_beacon) {
      for (std::size_t of = 0; of < books.size(); ++of)
        books[to].note(packet->from, of, packet->known[of], t);
    } else if (books[to].add(packet->name, packet->piece, t)) {
      ++entered;
    }
  }

  std::vector<NewsBook> books;
  double t = 0.0;
  int letters = 0, entered = 0;
};

TEST(NewsBook, SpreadsEachPieceOnce) {
  Talk talk(3);
  for (int number = 0; number < 5; ++number) {
    for (std::size_t i = 0; i < 3; ++i) talk.books[i].add_own(content(i, number));
  }
  for (int k = 0; k < 3; ++k)
    talk.go_on([&](std::size_t, std::size_t to, const Bytes& bytes) { talk.hear(to, bytes); });
  EXPECT_EQ(talk.entered, 3 * 5 * 2);
  for (const NewsBook& book : talk.books) {
    for (std::size_t of = 0; of < 3; ++of) EXPECT_EQ(book.known(of).next, 5U);
    EXPECT_EQ(book.memory_bytes(), 0U);  // all have all
  }
  EXPECT_LE(talk.letters, 3 * 5 + 2);
}

TEST(NewsBook, ComesToItsEndThroughARadioThatLosesHalfAndSpoilsTheRest) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937_64 random(seed);
    Talk talk(3);
    std::vector<std::pair<std::size_t, Bytes>> late;
    const auto carry = [&](std::size_t, std::size_t to, Bytes bytes) {
      if (random() % 2 == 0) return;
      if (random() % 5 == 0) bytes.resize(random() % bytes.size());
      if (random() % 5 == 0) bytes[random() % std::max<std::size_t>(bytes.size(), 1)] ^= std::byte{1};
      late.emplace_back(to, bytes);
      if (random() % 3 != 0) return;
      std::ranges::shuffle(late, random);
      for (const auto& [whom, packet] : late) talk.hear(whom, packet);
      late.clear();
    };
    for (int number = 0; number < 40; ++number) {
      for (std::size_t i = 0; i < 3; ++i) talk.books[i].add_own(content(i, number));
    }
    for (int k = 0; k < 30; ++k) talk.go_on(carry);
    EXPECT_EQ(talk.entered, 3 * 40 * 2) << seed;
  }
}

TEST(NewsBook, BringsNewsOfARobotThatDiedToThoseWhoNeverMetIt) {
  Talk talk(3);
  talk.books[0].add_own(content(0, 0));
  talk.go_on([&](std::size_t from, std::size_t to, const Bytes& bytes) {
    if (from + to == 1) talk.hear(to, bytes);  // 0 and 1
  });
  talk.go_on([&](std::size_t from, std::size_t to, const Bytes& bytes) {
    if (from != 0 && to != 0) talk.hear(to, bytes);
  });
  EXPECT_EQ(talk.books[2].known(0).next, 1U);
}

TEST(NewsBook, SendsNothingToThoseWhoAreNotHeard) {
  Talk talk(2);
  talk.books[0].add_own(content(0, 0));
  talk.go_on([](std::size_t, std::size_t, const Bytes&) {});
  EXPECT_EQ(talk.letters, 0);
}

TEST(NewsBook, RefusesPiecesOfItsOwnAndOfTheFarFuture) {
  NewsBook book(0, 2);
  EXPECT_FALSE(book.add({0, 0}, content(0, 0), 0.0));
  EXPECT_FALSE(book.add({1, 33}, content(1, 33), 0.0));
  EXPECT_TRUE(book.add({1, 32}, content(1, 32), 0.0));
  EXPECT_FALSE(book.add({1, 32}, content(1, 32), 0.0));
  EXPECT_EQ(book.known(1), (KnownPieces{.next = 0, .later = 1U << 31}));
}

TEST(Packet, IsNotOpenedIfAnyBitIsWrong) {
  NewsBook book(1, 3);
  const Bytes letter = piece_packet(1, {{2, 9}, content(2, 9)});
  EXPECT_TRUE(open_packet(letter, 3));
  EXPECT_TRUE(open_packet(beacon_packet(1, book), 3));
  EXPECT_FALSE(open_packet(beacon_packet(1, book), 2));  // of another team
  EXPECT_FALSE(open_packet(letter, 2));
  for (std::size_t i = 0; i < letter.size(); ++i) {
    Bytes wrong = letter;
    wrong[i] ^= std::byte{16};
    EXPECT_FALSE(open_packet(wrong, 3)) << i;
    EXPECT_FALSE(open_packet(std::span(letter).first(i), 3)) << i;
  }
}

}  // namespace
}  // namespace seif
