#include "browser.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness::test {

namespace {

/// The text between two others.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + before.size();
  return text.substr(from, text.find(after, from) - from);
}

}  // namespace

std::optional<std::string> find_browser(const TemporaryFolder& folder) {
  for (const char* name : {"chromium", "chromium-headless-shell"}) {
    if (call_program(folder, fmt::format("command -v {}", name)).exit_code == 0) return name;
  }
  return std::nullopt;
}

std::string look_at(const TemporaryFolder& folder, const std::string& browser,
                    const std::filesystem::path& page, const std::string& script, const Screen& screen) {
  std::string html = read_file(page);
  // The dump has to wait until the page is loaded, and a page with a frame that is still being written does not
  // count as loaded. So the page waits for the script in real time. In virtual time, frames may never come.
  html.insert(html.rfind("</body>"),
              fmt::format(R"(<pre id="looked"></pre><iframe id="looking" hidden></iframe><script>
const looking = document.getElementById("looking").contentDocument;
looking.open();
const result = {{}};
const until = async (condition) => {{
  for (let frame = 0; frame < 300 && !condition(); ++frame) await new Promise(requestAnimationFrame);
}};
(async () => {{
{}
}})().then(() => document.getElementById("looked").textContent = btoa(JSON.stringify(result)))
  .catch(console.error).finally(() => looking.close());
</script>)",
                          script));
  write_file(folder / "looked.html", html);
  const Called called = call_program(
      folder,
      fmt::format("{} --headless --no-sandbox --disable-gpu --user-data-dir=profile --window-size={},900 "
                  "--blink-settings=preferredColorScheme={} --enable-logging=stderr "
                  "--dump-dom looked.html",
                  browser, screen.width, screen.is_dark ? 0 : 1));
  const std::string looked = between(called.output, "<pre id=\"looked\">", "</pre>");
  if (looked.empty()) throw std::runtime_error("the page told nothing: " + called.errors);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string json;
  unsigned bits = 0;
  int count = 0;
  for (const char digit : looked) {
    if (digit == '=') break;
    bits = bits << 6U | static_cast<unsigned>(digits.find(digit));
    count += 6;
    if (count >= 8) json += static_cast<char>(bits >> (count -= 8) & 255U);
  }
  return json;
}

}  // namespace harness::test
