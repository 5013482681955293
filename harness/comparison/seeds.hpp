// Lists of seeds as users write them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace harness {

/// "1..3,7" means 1, 2, 3 and 7. The result is ascending, without repetition. Throws BadInput.
std::vector<std::uint64_t> parse_seeds(std::string_view text);

/// The shortest text for these seeds, which are ascending.
std::string seeds_text(std::span<const std::uint64_t> seeds);

}  // namespace harness
