#include <string_view>

#include "harness/files/bad_input.hpp"
#include "harness/live/request.hpp"
#include "targets.hpp"

namespace fuzz {

void read_request(std::string_view bytes) {
  try {
    static_cast<void>(harness::read_request(bytes));
  } catch (const harness::BadInput&) {  // as it should be
  }
}

}  // namespace fuzz
