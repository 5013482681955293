#include "worlds/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace worlds {
namespace {

/// The number of insertions, deletions and substitutions between two words, where a substitution counts
/// `substitution`: 1 is the Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t substitution) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : substitution);
      diagonal = std::exchange(row[j + 1], std::min({substituted, row[j] + 1, row[j + 1] + 1}));
    }
  }
  return row.back();
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("_-"), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

/// Whether the words of `part` stand side by side in `whole`. A single short word counts at the beginning
/// alone, because it may be a unit.
bool has_part(std::string_view whole, std::string_view part) {
  constexpr std::size_t longest_unit = 3;
  const std::vector<std::string_view> all = words_of(whole);
  const std::vector<std::string_view> few = words_of(part);
  if (few.empty() || few.size() >= all.size()) return false;
  const auto found = std::search(all.begin(), all.end(), few.begin(), few.end());
  if (few.size() == 1 && few.front().size() <= longest_unit) return found == all.begin();
  return found != all.end();
}

/// Smaller is more similar.
using Likeness = std::tuple<int, std::size_t, std::size_t>;

constexpr Likeness unlike{4, 0, 0};

Likeness likeness(std::string_view written, std::string_view choice) {
  constexpr std::size_t shortest_beginning = 3;
  const std::size_t distance = edit_distance(written, choice, 1);
  const std::size_t shifted = edit_distance(written, choice, 2);
  const bool shares_letters = distance < choice.size();
  const bool is_beginning = written.size() >= shortest_beginning && choice.starts_with(written);
  if (distance <= 1 && shares_letters) return {0, distance, shifted};
  if (is_beginning || has_part(choice, written)) return {1, distance, shifted};
  if (has_part(written, choice)) return {2, distance, shifted};
  if (distance < written.size() / 3 + 2 && shares_letters) return {3, distance, shifted};
  return unlike;
}

std::string_view without_dashes(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  return word;
}

}  // namespace

std::string most_similar(std::string_view written, const std::vector<std::string>& choices) {
  constexpr std::size_t longest = 64;  // longer texts are not typing mistakes
  if (written.size() > longest) return "";
  Likeness nearest = unlike;
  const std::string* best = nullptr;
  for (const std::string& choice : choices) {
    const Likeness likely = likeness(without_dashes(written), without_dashes(choice));
    if (likely >= nearest) continue;
    nearest = likely;
    best = &choice;
  }
  return best == nullptr ? "" : *best;
}

std::string suggestion(std::string_view written, const std::vector<std::string>& choices) {
  const std::string meant = most_similar(written, choices);
  return meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant);
}

}  // namespace worlds
