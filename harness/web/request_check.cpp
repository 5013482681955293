#include "harness/web/request_check.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cstddef>
#include <stdexcept>

namespace harness {

namespace {

/// The value of `token` in the query of a target; empty if it is not there.
std::string_view token_of(std::string_view target) {
  constexpr std::string_view key = "token=";
  std::size_t begin = target.find('?');
  while (begin != std::string_view::npos) {
    target.remove_prefix(begin + 1);
    const std::string_view pair = target.substr(0, target.find('&'));
    if (pair.starts_with(key)) return pair.substr(key.size());
    begin = target.find('&');
  }
  return {};
}

/// Compares in a time that does not tell how many characters are right.
bool is_same(std::string_view given, std::string_view wanted) {
  if (given.size() != wanted.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference |=
        static_cast<unsigned>(static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(wanted[i]));
  return difference == 0;
}

bool is_own_host(std::string_view host, const PageAddress& known) {
  if (is_everywhere(known.address)) return true;
  return host == fmt::format("{}:{}", known.address, known.port) ||
         host == fmt::format("[{}]:{}", known.address, known.port) ||
         host == fmt::format("localhost:{}", known.port);
}

}  // namespace

bool is_everywhere(std::string_view address) { return address == "0.0.0.0" || address == "::"; }

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers for the address of the page");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

Answer answer_to(const PageRequest& request, const PageAddress& known) {
  if (request.method != "GET") return Answer::bad_method;
  const std::string_view path = request.target.substr(0, request.target.find('?'));
  const bool is_socket = path == "/socket";
  if (path != "/" && !is_socket) return Answer::not_found;
  if (!is_same(token_of(request.target), known.token) || !is_own_host(request.host, known))
    return Answer::forbidden;
  const bool is_own_origin = request.origin == fmt::format("http://{}", request.host);
  if (!request.origin.empty() && !is_own_origin) return Answer::forbidden;
  if (!is_socket) return Answer::page;
  return request.wants_socket ? Answer::socket : Answer::not_found;
}

}  // namespace harness
