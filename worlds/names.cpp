#include "worlds/names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "worlds/field_spec.hpp"

namespace worlds {

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= longest_name && text.front() != '-' &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                  c == '-';
         });
}

std::string name_alphabet() {
  return fmt::format("at most {} letters, digits, '_' and '-', not beginning with '-'", longest_name);
}

}  // namespace worlds
