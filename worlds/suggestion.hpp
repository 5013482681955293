// What was meant by a word that is not known: a key, a command, an option, or a choice.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace worlds {

/// The choice that is most similar to what was written; empty if none is similar. Similar are: a typing mistake
/// (`sed` and `seed`); a part of the words (`x` and `x_m`, `range_m` and `max_range_m`), or too many of them
/// (`robot_mass_kg` and `mass_kg`). Words are joined by '_' or '-'; dashes in front of an option do not count.
std::string most_similar(std::string_view written, const std::vector<std::string>& choices);

/// " (did you mean 'x'?)" with the most similar choice; empty if no choice is similar.
std::string suggestion(std::string_view written, const std::vector<std::string>& choices);

}  // namespace worlds
