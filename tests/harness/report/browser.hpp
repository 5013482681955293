// Opens pages in a real browser, without a display.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/recording/run_folder.hpp"

namespace harness::test {

/// The installed browser: Debian's chromium or its headless part. Nothing if there is none.
std::optional<std::string> find_browser(const TemporaryFolder& folder);

struct Screen {
  int width = 1280;  // [px]
  bool is_dark = false;
};

/// Opens a page with a script at its end, and returns as JSON the value that the script has put into `result`.
/// The script may use `await until(() => ..)`, which waits for at most 300 frames. Throws std::runtime_error,
/// with the console's output, if there is no result.
std::string look_at(const TemporaryFolder& folder, const std::string& browser,
                    const std::filesystem::path& page, const std::string& script, const Screen& screen = {});

}  // namespace harness::test
