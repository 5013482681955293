#include "seif/team/packet.hpp"

#include <cstdint>

#include "seif/team/bytes.hpp"

namespace seif {
namespace {

enum : std::uint8_t { beacon_kind = 1, piece_kind = 2 };

/// The 32-bit hash of Fowler, Noll and Vo (RFC 9923).
std::uint32_t check_sum(std::span<const std::byte> bytes) {
  std::uint32_t hash = 0x811c9dc5U;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint32_t>(byte)) * 0x01000193U;
  return hash;
}

void seal(std::vector<std::byte>& packet) { ByteWriter(packet).put(check_sum(packet)); }

}  // namespace

std::vector<std::byte> beacon_packet(std::size_t from, const NewsBook& book) {
  std::vector<std::byte> packet;
  ByteWriter to(packet);
  to.put(std::uint8_t{beacon_kind});
  to.put(static_cast<std::uint8_t>(from));
  for (std::size_t of = 0; of < book.robots(); ++of) {
    const KnownPieces known = book.known(of);
    to.put(known.next);
    to.put(known.later);
  }
  seal(packet);
  return packet;
}

std::vector<std::byte> piece_packet(std::size_t from, const NewsBook::Letter& letter) {
  std::vector<std::byte> packet;
  ByteWriter to(packet);
  to.put(std::uint8_t{piece_kind});
  to.put(static_cast<std::uint8_t>(from));
  to.put(static_cast<std::uint8_t>(letter.name.robot));
  to.put(letter.name.number);
  to.put(letter.piece);
  seal(packet);
  return packet;
}

std::optional<Packet> open_packet(std::span<const std::byte> bytes, std::size_t robots) {
  if (bytes.size() <= sizeof(std::uint32_t)) return std::nullopt;
  const std::span<const std::byte> content = bytes.first(bytes.size() - sizeof(std::uint32_t));
  if (ByteReader(bytes.subspan(content.size())).get<std::uint32_t>() != check_sum(content))
    return std::nullopt;
  ByteReader from(content);
  Packet packet;
  const auto kind = from.get<std::uint8_t>();
  packet.from = from.get<std::uint8_t>();
  packet.is_beacon = kind == beacon_kind;
  if (packet.from >= robots || (!packet.is_beacon && kind != piece_kind)) return std::nullopt;
  if (packet.is_beacon) {
    for (std::size_t of = 0; of < robots; ++of) {
      const auto next = from.get<std::uint32_t>();
      packet.known.push_back({.next = next, .later = from.get<std::uint32_t>()});
    }
    if (!from.is_at_end()) return std::nullopt;
    return packet;
  }
  packet.name.robot = from.get<std::uint8_t>();
  packet.name.number = from.get<std::uint32_t>();
  packet.piece = from.rest();
  if (!from.is_whole() || packet.name.robot >= robots) return std::nullopt;
  return packet;
}

}  // namespace seif
