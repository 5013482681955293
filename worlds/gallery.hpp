// The worlds that come with the program.
#pragma once

#include <filesystem>

namespace worlds {

/// The file of a world. A bare name, such as `courtyard`, that is no file itself is a world of the gallery: of the
/// installed copy that the program belongs to, or of the sources that it was built from. Anything else is returned
/// as it is, and so is a name that the gallery does not have.
std::filesystem::path find_world(const std::filesystem::path& name);

}  // namespace worlds
