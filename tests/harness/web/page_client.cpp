#include "page_client.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace harness::test {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

template <class Value>
std::vector<Value> values_of(const std::vector<std::uint8_t>& bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

tcp::endpoint local(std::uint16_t port) { return {asio::ip::make_address("127.0.0.1"), port}; }

std::string host_of(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

}  // namespace

std::vector<float> ReceivedMessage::floats(const std::string& name) const {
  return values_of<float>(arrays.at(name));
}

std::vector<std::uint32_t> ReceivedMessage::numbers(const std::string& name) const {
  return values_of<std::uint32_t>(arrays.at(name));
}

ReceivedMessage decoded(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t length = 0;
  if (bytes.size() < sizeof(length)) throw std::runtime_error("too short a message");
  std::memcpy(&length, bytes.data(), sizeof(length));
  if (bytes.size() < sizeof(length) + length) throw std::runtime_error("the JSON of a message is cut off");
  ReceivedMessage message;
  const auto* text = reinterpret_cast<const char*>(bytes.data()) + sizeof(length);
  message.json = nlohmann::json::parse(text, text + length);
  std::size_t at = sizeof(length) + length;
  for (const nlohmann::json& array : message.json.at("arrays")) {
    const std::size_t size = array.at(2).get<std::size_t>() * (array.at(1) == "u8" ? 1 : 4);
    if (at + size > bytes.size()) throw std::runtime_error("an array of a message is cut off");
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    message.arrays[array.at(0)] = {begin, begin + static_cast<std::ptrdiff_t>(size)};
    at += (size + 3) / 4 * 4;
  }
  if (at != bytes.size()) throw std::runtime_error("a message has more bytes than it says");
  return message;
}

HttpAnswer http_get(std::uint16_t port, const std::string& target,
                    const std::map<std::string, std::string>& headers, const std::string& method) {
  asio::io_context context;
  beast::tcp_stream stream(context);
  stream.connect(local(port));
  http::request<http::string_body> request{http::verb::get, target, 11};
  request.method_string(method);
  request.set(http::field::host, host_of(port));
  for (const auto& [name, value] : headers) request.set(name, value);
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(64U << 20U);
  http::read(stream, buffer, parser);
  HttpAnswer answer{parser.get().result_int(), parser.get().body(), {}};
  for (const auto& field : parser.get())
    answer.headers[std::string(field.name_string())] = std::string(field.value());
  return answer;
}

struct PageClient::Core {
  asio::io_context context;
  beast::websocket::stream<beast::tcp_stream> socket{context};
  beast::flat_buffer buffer;
};

PageClient::PageClient(std::uint16_t port, const std::string& target,
                       const std::map<std::string, std::string>& headers)
    : core_(std::make_unique<Core>()) {
  beast::get_lowest_layer(core_->socket).connect(local(port));
  core_->socket.set_option(
      beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
        for (const auto& [name, value] : headers) request.set(name, value);
      }));
  core_->socket.read_message_max(64U << 20U);
  boost::system::error_code error;
  core_->socket.handshake(host_of(port), target, error);
  if (error) throw std::runtime_error("refused: " + error.message());
}

PageClient::~PageClient() = default;
PageClient::PageClient(PageClient&&) noexcept = default;

void PageClient::send(const std::string& text) {
  core_->socket.text(true);
  boost::system::error_code error;
  core_->socket.write(asio::buffer(text), error);
}

std::optional<ReceivedMessage> PageClient::receive() {
  core_->buffer.clear();
  boost::system::error_code error;
  core_->socket.read(core_->buffer, error);
  if (error) return std::nullopt;
  const auto data = core_->buffer.cdata();
  const auto* begin = static_cast<const std::uint8_t*>(data.data());
  return decoded({begin, begin + data.size()});
}

ReceivedMessage PageClient::wait_for(const std::string& kind,
                                     const std::function<bool(const nlohmann::json&)>& wanted) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(240);
  while (std::chrono::steady_clock::now() < end) {
    std::optional<ReceivedMessage> message = receive();
    if (!message) throw std::runtime_error("the connection was closed before a message of kind " + kind);
    if (message->json.at("kind") == kind && (!wanted || wanted(message->json))) return std::move(*message);
  }
  throw std::runtime_error("no message of kind " + kind);
}

void PageClient::drop() {
  boost::system::error_code ignored;
  beast::get_lowest_layer(core_->socket).socket().close(ignored);
}

}  // namespace harness::test
