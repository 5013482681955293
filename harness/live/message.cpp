#include "harness/live/message.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>

namespace harness {

static_assert(std::endian::native == std::endian::little, "pages read little endian");

void MessageArrays::clear() {
  list_ = "[]";
  bytes_.clear();
}

void MessageArrays::append(std::string_view name, std::string_view type, std::size_t count, const void* data,
                           std::size_t size) {
  list_.pop_back();
  fmt::format_to(std::back_inserter(list_), "{}[\"{}\",\"{}\",{}]]", list_.size() > 1 ? "," : "", name, type,
                 count);
  const std::size_t begin = bytes_.size();
  bytes_.resize(begin + (size + 3) / 4 * 4);
  if (size > 0) std::memcpy(bytes_.data() + begin, data, size);
}

void MessageArrays::add(std::string_view name, std::span<const float> values) {
  append(name, "f32", values.size(), values.data(), values.size_bytes());
}

void MessageArrays::add(std::string_view name, std::span<const std::uint32_t> values) {
  append(name, "u32", values.size(), values.data(), values.size_bytes());
}

void MessageArrays::add(std::string_view name, std::span<const std::uint8_t> values) {
  append(name, "u8", values.size(), values.data(), values.size_bytes());
}

void write_message(std::string_view json, const MessageArrays& arrays, PageMessage& message) {
  std::string text(json.substr(0, json.size() - 1));
  text += text.size() > 1 ? ",\"arrays\":" : "\"arrays\":";
  text += arrays.list();
  text += '}';
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  message.resize(sizeof(length) + text.size() + arrays.bytes().size());
  std::memcpy(message.data(), &length, sizeof(length));
  std::memcpy(message.data() + sizeof(length), text.data(), text.size());
  if (!arrays.bytes().empty())
    std::memcpy(message.data() + sizeof(length) + text.size(), arrays.bytes().data(), arrays.bytes().size());
}

}  // namespace harness
