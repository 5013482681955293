// A page as the server sees it: a WebSocket, without a browser.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace harness::test {

/// A message from the server: its JSON, and the bytes of its arrays by name.
struct ReceivedMessage {
  nlohmann::json json;
  std::map<std::string, std::vector<std::uint8_t>> arrays;

  std::vector<float> floats(const std::string& name) const;
  std::vector<std::uint32_t> numbers(const std::string& name) const;
};

/// Throws std::runtime_error if the bytes are no message.
ReceivedMessage decoded(const std::vector<std::uint8_t>& bytes);

/// How a server answers a plain HTTP request.
struct HttpAnswer {
  unsigned status = 0;
  std::string body;
  std::map<std::string, std::string> headers;
};

/// GET with these headers. `method` may be another one.
HttpAnswer http_get(std::uint16_t port, const std::string& target,
                    const std::map<std::string, std::string>& headers = {},
                    const std::string& method = "GET");

class PageClient {
 public:
  /// Connects. `target` is path and query. Throws std::runtime_error if the server refuses it.
  PageClient(std::uint16_t port, const std::string& target,
             const std::map<std::string, std::string>& headers = {});
  ~PageClient();
  PageClient(PageClient&&) noexcept;
  PageClient& operator=(PageClient&&) = delete;

  void send(const std::string& text);

  /// The next message; nothing if the connection was closed.
  std::optional<ReceivedMessage> receive();
  /// The next message of this kind for which `wanted` holds. Throws std::runtime_error if the connection is closed, or
  /// after 60 s.
  ReceivedMessage wait_for(const std::string& kind,
                           const std::function<bool(const nlohmann::json&)>& wanted = {});
  /// Closes the connection without a farewell, as a browser that crashes does.
  void drop();

 private:
  struct Core;
  std::unique_ptr<Core> core_;
};

}  // namespace harness::test
