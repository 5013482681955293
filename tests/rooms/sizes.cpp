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

/// `enum class`, `template <class A, class B>`.
bool is_no_class_after(std::string_view token) { return token == "enum" || token == "<" || token == ","; }

/// Reads the tokens between the braces of a class one by one.
class PrivateFunctions {
 public:
  void read(const Token& token, const Token& next) {
    const std::string& text = token.text;
    if (text == "{") ++braces_;
    if (text == "}") --braces_;
    if (braces_ > 0) return;
    if (next.text == ":" && (text == "private" || text == "protected" || text == "public"))
      is_private_ = text == "private";
    if (text == ";" || text == "}") is_counted_ = false;
    if (text == "<") ++angles_;
    if (text == ">") --angles_;
    if (text == "=") is_counted_ = true;  // a field with its value
    if (text != "(" || angles_ > 0 || is_counted_) return;
    is_counted_ = true;
    if (is_private_) ++count_;
  }
  int count() const { return count_; }

 private:
  int braces_ = 0, angles_ = 0;  // [-] open ones
  bool is_private_ = true;
  bool is_counted_ = false;  // the present declaration
  int count_ = 0;
};

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

Findings check_private_functions(const Source& source) {
  Findings findings;
  const std::vector<Token>& tokens = source.tokens;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].text != "class" || (i > 0 && is_no_class_after(tokens[i - 1].text))) continue;
    const auto is_end = [](const Token& token) { return token.text == "{" || token.text == ";"; };
    const auto open = std::find_if(tokens.begin() + static_cast<std::ptrdiff_t>(i), tokens.end(), is_end);
    if (open == tokens.end() || open->text != "{") continue;
    const auto first = static_cast<std::size_t>(open - tokens.begin());
    const std::size_t end = closing(tokens, first);
    PrivateFunctions functions;
    for (std::size_t k = first + 1; k + 1 < tokens.size() && k < end; ++k)
      functions.read(tokens[k], tokens[k + 1]);
    if (functions.count() > most_private_functions) {
      findings.push_back(source.path + ":" + std::to_string(tokens[i].line) + ": " + tokens[i + 1].text +
                         " has " + std::to_string(functions.count()) + " private functions");
    }
  }
  return findings;
}

}  // namespace rooms
