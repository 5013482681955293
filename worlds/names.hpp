// Names of things in a world file. They are those of files, too.
#pragma once

#include <string>
#include <string_view>

namespace worlds {

/// Whether a text can be a name: see name_alphabet().
bool is_name(std::string_view text);

/// What a name may consist of, for messages.
std::string name_alphabet();

}  // namespace worlds
