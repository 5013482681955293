#include "browser_page.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace harness::test {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using nlohmann::json;

constexpr std::chrono::seconds longest{240};

/// Waits until `done` gives something that is not empty.
template <class Done>
auto eventually(const Done& done, const std::string& what) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (std::chrono::steady_clock::now() < end) {
    if (auto result = done()) return result;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("it did not happen in four minutes: " + what);
}

tcp::endpoint local(unsigned port) {
  return {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(port)};
}

json get(unsigned port, const std::string& target) {
  asio::io_context context;
  beast::tcp_stream stream(context);
  stream.connect(local(port));
  http::request<http::empty_body> request{http::verb::get, target, 11};
  request.set(http::field::host, "127.0.0.1");
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(stream, buffer, response);
  return json::parse(response.body());
}

/// The socket of the first page.
std::string socket_path(unsigned port) {
  for (const json& target : get(port, "/json/list")) {
    if (target.at("type") != "page") continue;
    const std::string url = target.at("webSocketDebuggerUrl");
    return url.substr(url.find("/devtools"));
  }
  return {};
}

pid_t start(const std::vector<std::string>& words, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // its own processes end with it
  pid_t process = -1;
  const int error =
      posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::runtime_error("cannot start " + words.front());
  return process;
}

std::string decoded_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char digit : text) {
    if (digit == '=') break;
    bits = bits << 6U | static_cast<unsigned>(digits.find(digit));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255U);
  }
  return bytes;
}

}  // namespace

struct BrowserPage::Core {
  ~Core() {
    if (process <= 0) return;
    kill(-process, SIGKILL);
    waitpid(process, nullptr, 0);
  }

  pid_t process = -1;
  asio::io_context context;
  beast::websocket::stream<beast::tcp_stream> socket{context};
  int calls = 0;
};

BrowserPage::BrowserPage(const TemporaryFolder& folder, const std::string& browser, const std::string& url,
                         const PageScreen& screen)
    : core_(std::make_unique<Core>()) {
  const std::filesystem::path profile = folder / "profile";
  std::filesystem::remove_all(profile);  // that of an earlier page
  core_->process =
      start({browser, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--remote-debugging-port=0",
             "--user-data-dir=" + profile.string(),
             "--window-size=" + std::to_string(screen.width) + "," + std::to_string(screen.height),
             std::string("--blink-settings=preferredColorScheme=") + (screen.is_dark ? "0" : "1"), url},
            folder / "browser.log");
  const unsigned port = *eventually(
      [&]() -> std::optional<unsigned> {
        std::ifstream file(profile / "DevToolsActivePort");
        unsigned number = 0;
        return file >> number ? std::optional(number) : std::nullopt;
      },
      "the browser starts");
  std::string path;
  eventually([&] { return !(path = socket_path(port)).empty(); }, "the browser opens a page");
  beast::get_lowest_layer(core_->socket).connect(local(port));
  core_->socket.read_message_max(64U << 20U);
  core_->socket.handshake("127.0.0.1:" + std::to_string(port), path);
}

BrowserPage::~BrowserPage() = default;

json BrowserPage::call(const std::string& method, json parameters) {
  const int id = ++core_->calls;
  core_->socket.write(
      asio::buffer(json{{"id", id}, {"method", method}, {"params", std::move(parameters)}}.dump()));
  while (true) {
    beast::flat_buffer buffer;
    core_->socket.read(buffer);
    json answer = json::parse(beast::buffers_to_string(buffer.data()));
    if (answer.value("id", 0) != id) continue;  // something that happened meanwhile
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer.at("error").dump());
    return answer.at("result");
  }
}

json BrowserPage::evaluate(const std::string& expression) {
  const json result =
      call("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (result.contains("exceptionDetails"))
    throw std::runtime_error(expression + ": " + result.at("exceptionDetails").dump());
  return result.at("result").value("value", json());
}

void BrowserPage::wait_until(const std::string& expression) {
  const auto is_true = [&] {
    try {
      return evaluate("!!(" + expression + ")") == true;
    } catch (const std::runtime_error&) {  // the page has not been loaded yet
      return false;
    }
  };
  eventually(is_true, expression);
}

void BrowserPage::press(const std::string& key) {
  for (const char* type : {"keyDown", "keyUp"}) {
    json parameters = {{"type", type}, {"key", key}};
    if (key.size() == 1 && type == std::string("keyDown")) parameters["text"] = key;
    call("Input.dispatchKeyEvent", std::move(parameters));
  }
}

void BrowserPage::drag(double from_x, double from_y, double to_x, double to_y) {
  const auto mouse = [&](const char* type, double x, double y) {
    call("Input.dispatchMouseEvent",
         {{"type", type}, {"x", x}, {"y", y}, {"button", "left"}, {"buttons", 1}, {"clickCount", 1}});
  };
  mouse("mousePressed", from_x, from_y);
  for (int i = 1; i <= 4; ++i)
    mouse("mouseMoved", from_x + 0.25 * i * (to_x - from_x), from_y + 0.25 * i * (to_y - from_y));
  mouse("mouseReleased", to_x, to_y);
}

void BrowserPage::save_picture(const std::filesystem::path& file) {
  const json picture = call("Page.captureScreenshot", {{"format", "png"}});
  std::ofstream(file, std::ios::binary) << decoded_base64(picture.at("data"));
}

}  // namespace harness::test
