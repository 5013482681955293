// What robots broadcast: a beacon says what a robot has, a letter brings one piece.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "seif/team/news_book.hpp"

namespace seif {

struct Packet {
  std::size_t from = 0;  // robot
  bool is_beacon = false;
  std::vector<KnownPieces> known = {};  // beacon: by robot
  PieceName name = {};                  // letter
  std::span<const std::byte> piece = {};
};

std::vector<std::byte> beacon_packet(std::size_t from, const NewsBook& book);
std::vector<std::byte> piece_packet(std::size_t from, const NewsBook::Letter& letter);

/// Nothing if it is not whole, as its check sum says, or of another team. The piece refers to `bytes`.
std::optional<Packet> open_packet(std::span<const std::byte> bytes, std::size_t robots);

}  // namespace seif
