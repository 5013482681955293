#include "harness/web/page_server.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <map>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "harness/web/request_check.hpp"

namespace harness {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using Error = boost::system::error_code;

constexpr std::chrono::seconds request_timeout{10};
constexpr std::chrono::seconds idle_timeout{
    30};  // half of it later, a page is asked whether it is still there
constexpr std::size_t longest_header = 16 * 1024;  // [byte]

/// The page may run its own script, and connect to this server. Everything else is forbidden to it.
constexpr const char* content_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src 'self' ws: "
    "blob:; "
    "img-src data: blob:; media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

std::pair<http::status, const char*> words_of(Answer answer) {
  switch (answer) {
    case Answer::bad_method:
      return {http::status::method_not_allowed, "only GET is answered\n"};
    case Answer::forbidden:
      return {http::status::forbidden, "open the address that the program has printed, with its token\n"};
    case Answer::page:
    case Answer::socket:
    case Answer::not_found:
      break;
  }
  return {http::status::not_found, "there is only one page here\n"};
}

}  // namespace

// Named: a member of PageServer::Core has these types.
namespace page_server {

/// What the connections of a server share.
struct Shared {
  PageServerPlan plan;
  PageHandler& handler;
  PageAddress address;
  std::map<PageId, class PageSocket*> pages = {};
  int connections = 0;  // [-] open ones, pages among them
  PageId last_id = 0;
};

/// Counts a connection while it is open.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.connections; }
  ~Counted() { --shared_.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Shared& shared_;
};

/// An open page.
class PageSocket : public std::enable_shared_from_this<PageSocket> {
 public:
  PageSocket(tcp::socket socket, Shared& shared)
      : socket_(std::move(socket)), shared_(shared), counted_(shared) {}
  ~PageSocket() {
    if (id_ == 0) return;
    shared_.pages.erase(id_);
    shared_.handler.closed(id_);
  }
  PageSocket(const PageSocket&) = delete;
  PageSocket& operator=(const PageSocket&) = delete;

  void start(const http::request<http::empty_body>& request) {
    websocket::stream_base::timeout timeouts{request_timeout, idle_timeout, true};
    socket_.set_option(timeouts);
    socket_.read_message_max(shared_.plan.longest_text);
    socket_.binary(true);
    socket_.async_accept(request, [self = shared_from_this()](const Error& error) {
      if (error) return;
      self->id_ = ++self->shared_.last_id;
      self->shared_.pages[self->id_] = self.get();
      self->shared_.handler.opened(self->id_);
      self->read();
      self->send_next();
    });
  }

  /// Sends what there is, unless the page has not yet taken the last message.
  void send_next() {
    if (is_sending_ || is_closing_ || !shared_.handler.next(id_, message_)) return;
    is_sending_ = true;
    socket_.async_write(asio::buffer(message_), [self = shared_from_this()](const Error& error, std::size_t) {
      self->is_sending_ = false;
      if (!error) self->send_next();
    });
  }

  void close() {
    is_closing_ = true;
    Error ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

 private:
  void read() {
    socket_.async_read(incoming_, [self = shared_from_this()](const Error& error, std::size_t) {
      if (error) return self->close();
      if (self->is_too_fast()) return self->close();
      const beast::flat_buffer::const_buffers_type data = self->incoming_.cdata();
      self->shared_.handler.received(self->id_, {static_cast<const char*>(data.data()), data.size()});
      self->incoming_.consume(self->incoming_.size());
      self->read();
    });
  }

  bool is_too_fast() {
    const Clock::time_point now = Clock::now();
    if (now - second_began_ > std::chrono::seconds(1)) {
      second_began_ = now;
      texts_ = 0;
    }
    return ++texts_ > shared_.plan.texts_per_second;
  }

  websocket::stream<beast::tcp_stream> socket_;
  Shared& shared_;
  Counted counted_;
  PageId id_ = 0;  // 0: not yet open
  beast::flat_buffer incoming_;
  PageMessage message_;  // on its way while `is_sending_`
  bool is_sending_ = false;
  bool is_closing_ = false;
  Clock::time_point second_began_;
  int texts_ = 0;  // [-] since then
};

/// A connection whose request is being read and answered.
class Request : public std::enable_shared_from_this<Request> {
 public:
  Request(tcp::socket socket, Shared& shared)
      : stream_(std::move(socket)), shared_(shared), counted_(shared) {}

  void start() {
    parser_.header_limit(longest_header);
    stream_.expires_after(request_timeout);
    http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](const Error& error, std::size_t) {
      if (!error) self->answer();
    });
  }

 private:
  void answer() {
    const http::request<http::empty_body>& request = parser_.get();
    const std::string method(request.method_string());
    const Answer answer = answer_to({method, text_of(request.target()), text_of(request[http::field::host]),
                                     text_of(request[http::field::origin]), websocket::is_upgrade(request)},
                                    shared_.address);
    if (answer == Answer::socket) {
      stream_.expires_never();
      std::make_shared<PageSocket>(stream_.release_socket(), shared_)->start(request);
    } else if (answer == Answer::page) {
      reply(http::status::ok, "text/html; charset=utf-8", shared_.plan.html);
    } else {
      const auto [status, words] = words_of(answer);
      reply(status, "text/plain; charset=utf-8", words);
    }
  }

  void reply(http::status status, const char* type, const std::string& body) {
    response_.result(status);
    response_.version(parser_.get().version());
    response_.set(http::field::content_type, type);
    response_.set("Content-Security-Policy", content_policy);
    response_.set(http::field::cache_control, "no-store");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.keep_alive(false);
    response_.body() = body;
    response_.prepare_payload();
    http::async_write(stream_, response_, [self = shared_from_this()](const Error&, std::size_t) {
      Error ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  Counted counted_;
  beast::flat_buffer buffer_{longest_header};
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
};

}  // namespace page_server

class PageServer::Core {
 public:
  Core(PageServerPlan plan, PageHandler& handler)
      : token_(random_token()), shared_{std::move(plan), handler, {}}, acceptor_(context_), timer_(context_) {
    try {
      const tcp::endpoint endpoint(asio::ip::make_address(shared_.plan.address), shared_.plan.port);
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw std::system_error(
          error.code().value(), std::system_category(),
          fmt::format("cannot listen at {}, port {}", shared_.plan.address, shared_.plan.port));
    }
    shared_.address = {shared_.plan.address, acceptor_.local_endpoint().port(), token_};
    accept();
    tick();
    thread_ = std::thread([this] { context_.run(); });
  }

  ~Core() {
    asio::post(context_, [this] { stop(); });
    thread_.join();
  }
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  /// The address by which this machine itself reaches the server.
  std::string host() const {
    const std::string& address = shared_.plan.address;
    if (is_everywhere(address)) return "127.0.0.1";
    return address.find(':') == std::string::npos ? address : '[' + address + ']';
  }
  std::uint16_t port() const { return shared_.address.port; }
  const std::string& token() const { return token_; }

 private:
  void accept() {
    acceptor_.async_accept([this](const Error& error, tcp::socket socket) {
      if (is_stopping_) return;
      if (!error && shared_.connections < shared_.plan.most_pages)
        std::make_shared<page_server::Request>(std::move(socket), shared_)->start();
      if (!error) return accept();
      // Too many open files, for instance: others may close theirs.
      retry_.emplace(context_, std::chrono::milliseconds(100));
      retry_->async_wait([this](const Error&) {
        if (!is_stopping_) accept();
      });
    });
  }

  void tick() {
    timer_.expires_after(std::chrono::microseconds(1'000'000 / shared_.plan.ticks_per_second));
    timer_.async_wait([this](const Error& error) {
      if (error || is_stopping_) return;
      shared_.handler.tick();
      for (const auto& [id, page] : shared_.pages) page->send_next();
      tick();
    });
  }

  void stop() {
    is_stopping_ = true;
    Error ignored;
    acceptor_.close(ignored);
    timer_.cancel();
    if (retry_) retry_->cancel();
    for (const auto& [id, page] : shared_.pages) page->close();
    context_.stop();
  }

  std::string token_;
  page_server::Shared shared_;
  asio::io_context context_;  // destroyed before `shared_`: its pending calls hold pages
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  std::optional<asio::steady_timer> retry_;
  bool is_stopping_ = false;
  std::thread thread_;
};

PageServer::PageServer(PageServerPlan plan, PageHandler& handler)
    : core_(std::make_unique<Core>(std::move(plan), handler)) {
  url_ = fmt::format("http://{}:{}/?token={}", core_->host(), core_->port(), core_->token());
}

PageServer::~PageServer() = default;

std::uint16_t PageServer::port() const { return core_->port(); }

const std::string& PageServer::token() const { return core_->token(); }

}  // namespace harness
