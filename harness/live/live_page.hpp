// The page of a live run, as one document.
#pragma once

#include <string>

namespace harness {

/// The page with everything that it needs inside. Throws std::runtime_error if a library is not installed.
std::string live_page(const std::string& title);

}  // namespace harness
