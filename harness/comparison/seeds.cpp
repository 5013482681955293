#include "harness/comparison/seeds.hpp"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "harness/files/bad_input.hpp"
#include "harness/terminal/checks.hpp"

namespace harness {

namespace {

constexpr std::uint64_t most_seeds = 100'000;
constexpr auto largest = static_cast<std::uint64_t>(largest_seed);

std::uint64_t parse_seed(std::string_view text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size())
    throw BadInput(fmt::format("--seeds: '{}' is no seed; what is meant is like 1..20 or 1,2,7", text));
  if (seed > largest)
    throw BadInput(fmt::format("--seeds: '{}' is not allowed: a seed is from 0 to {}", text, largest));
  return seed;
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(std::string_view text) {
  std::set<std::uint64_t> seeds;
  while (true) {
    const std::string_view part = text.substr(0, text.find(','));
    const std::size_t dots = part.find("..");
    const std::uint64_t first = parse_seed(part.substr(0, dots));
    const std::uint64_t last = dots == std::string_view::npos ? first : parse_seed(part.substr(dots + 2));
    if (last < first || last - first >= most_seeds)
      throw BadInput(fmt::format("--seeds: {} is no range of at most {} seeds", part, most_seeds));
    for (std::uint64_t step = 0; step <= last - first; ++step) seeds.insert(first + step);
    if (part.size() == text.size()) return {seeds.begin(), seeds.end()};
    text.remove_prefix(part.size() + 1);
  }
}

std::string seeds_text(std::span<const std::uint64_t> seeds) {
  std::string text;
  for (std::size_t begin = 0; begin < seeds.size();) {
    std::size_t end = begin + 1;
    while (end < seeds.size() && seeds[end] == seeds[end - 1] + 1) ++end;
    if (begin > 0) text += ',';
    text += fmt::format("{}", seeds[begin]);
    if (end - begin > 1) text += fmt::format("..{}", seeds[end - 1]);
    begin = end;
  }
  return text;
}

}  // namespace harness
