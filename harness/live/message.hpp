// Messages to a page: a JSON text, and arrays of numbers. docs/live.md describes the format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/web/page_server.hpp"

namespace harness {

/// Collects the arrays of a message. Memory is reused from message to message.
class MessageArrays {
 public:
  void clear();
  void add(std::string_view name, std::span<const float> values);
  void add(std::string_view name, std::span<const std::uint32_t> values);
  void add(std::string_view name, std::span<const std::uint8_t> values);

  /// `[["name","f32",3],..]`, as the JSON of the message has it.
  const std::string& list() const { return list_; }
  std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  void append(std::string_view name, std::string_view type, std::size_t count, const void* data,
              std::size_t size);

  std::string list_ = "[]";
  std::vector<std::uint8_t> bytes_;
};

/// Overwrites `message`. `json` is an object without "arrays"; it is added.
void write_message(std::string_view json, const MessageArrays& arrays, PageMessage& message);

}  // namespace harness
