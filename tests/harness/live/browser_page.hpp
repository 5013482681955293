// A page in a real browser, without a display, driven by the browser's own protocol for developers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/recording/run_folder.hpp"

namespace harness::test {

struct PageScreen {
  int width = 1280, height = 800;  // [px]
  bool is_dark = false;
};

class BrowserPage {
 public:
  /// Starts the browser, which keeps its files in the folder, and opens the address. Throws std::runtime_error.
  BrowserPage(const TemporaryFolder& folder, const std::string& browser, const std::string& url,
              const PageScreen& screen = {});
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

  /// The value of an expression of JavaScript; a promise is awaited. Throws std::runtime_error with what it threw.
  nlohmann::json evaluate(const std::string& expression);
  /// Waits until an expression is true. Throws std::runtime_error after 240 s.
  void wait_until(const std::string& expression);
  /// Presses and releases a key, such as "s" or " ".
  void press(const std::string& key);
  /// Moves the mouse with its left button down, from one point of the page to another. [px]
  void drag(double from_x, double from_y, double to_x, double to_y);
  void save_picture(const std::filesystem::path& file);

 private:
  struct Core;

  nlohmann::json call(const std::string& method, nlohmann::json parameters);

  std::unique_ptr<Core> core_;
};

}  // namespace harness::test
