// A real browser without a display, for pages.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/recording/run_folder.hpp"

namespace harness::test {

/// The browser that there is: Debian's chromium or its headless part; nothing without one.
std::optional<std::string> find_browser(const TemporaryFolder& folder);

struct Screen {
  int width = 1280;  // [px]
  bool is_dark = false;
};

/// Opens a page with a script at its end, and returns as JSON what that has put into `result`. The script may
/// `await until(() => ..)`: for at most 300 frames.
/// Throws std::runtime_error, with the console, if nothing came.
std::string look_at(const TemporaryFolder& folder, const std::string& browser,
                    const std::filesystem::path& page, const std::string& script, const Screen& screen = {});

}  // namespace harness::test
