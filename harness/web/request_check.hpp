// Decides which requests the server of a page answers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace harness {

/// A random token of 32 hex digits. Throws std::runtime_error if the system has no randomness.
std::string random_token();

/// Whether a server at this address listens at all addresses of this machine.
bool is_everywhere(std::string_view address);

/// What a request says about itself.
struct PageRequest {
  std::string_view method;  // GET, ..
  std::string_view target;  // path and query
  std::string_view host;    // the header; empty: not given
  std::string_view origin;  // the header; empty: not given
  bool wants_socket = false;
};

/// What the server knows.
struct PageAddress {
  std::string_view address;  // that it listens at
  std::uint16_t port = 0;
  std::string_view token;
};

enum class Answer { page, socket, bad_method, forbidden, not_found };

/// The page is at `/`, its socket at `/socket`, both with `?token=`. A request with the wrong token is forbidden,
/// and so is one whose Origin is not this server. A server that listens at one address only also refuses a Host
/// header that is neither that address nor localhost: a foreign name that resolves to this machine.
Answer answer_to(const PageRequest& request, const PageAddress& known);

}  // namespace harness
