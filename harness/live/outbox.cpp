#include "harness/live/outbox.hpp"

#include <nlohmann/json.hpp>

#include "harness/live/message.hpp"

namespace harness {

PageMessage said(bool is_error, std::string_view text, std::int64_t seq) {
  const nlohmann::ordered_json json = {
      {"kind", "said"}, {"level", is_error ? "error" : "info"}, {"text", text}, {"seq", seq}};
  PageMessage message;
  write_message(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), {}, message);
  return message;
}

}  // namespace harness
