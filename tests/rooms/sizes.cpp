#include "sizes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rooms {
namespace {

/// Whether the brace at `at` opens a function: `) {`, `) const {`, `) override {`. Constructors count, as their
/// list of members ends in `)`.
bool opens_function(const std::vector<Token>& tokens, std::size_t at) {
  static constexpr std::array<std::string_view, 4> qualifiers = {"const", "noexcept", "override", "final"};
  while (at > 0 && std::ranges::find(qualifiers, tokens[at - 1].text) != qualifiers.end()) --at;
  return at > 0 && tokens[at - 1].text == ")";
}

/// The index of the brace that closes the one at `open`, or the number of tokens.
std::size_t closing(const std::vector<Token>& tokens, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < tokens.size(); ++i) {
    if (tokens[i].text == "{") ++depth;
    if (tokens[i].text == "}" && --depth == 0) return i;
  }
  return tokens.size();
}

}  // namespace

Findings check_header_length(const TextFile& file) {
  const auto lines = std::ranges::count(file.text, '\n');
  if (!file.path.ends_with(".hpp") || lines <= longest_header) return {};
  return {file.path + ":1: a header of " + std::to_string(lines) + " lines"};
}

Findings check_function_lengths(const Source& source) {
  Findings findings;
  for (std::size_t i = 0; i < source.tokens.size(); ++i) {
    if (source.tokens[i].text != "{" || !opens_function(source.tokens, i)) continue;
    const std::size_t end = closing(source.tokens, i);
    if (end == source.tokens.size()) break;
    const int lines = source.tokens[end].line - source.tokens[i].line + 1;
    if (lines > longest_function) {
      findings.push_back(source.path + ":" + std::to_string(source.tokens[i].line) + ": a function of " +
                         std::to_string(lines) + " lines");
    }
    i = end;
  }
  return findings;
}

}  // namespace rooms
