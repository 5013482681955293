#include "targets.hpp"

namespace fuzz {

const std::map<std::string_view, Target>& targets() {
  static const std::map<std::string_view, Target> all = {{"worlds", read_world},
                                                         {"overrides", read_override},
                                                         {"logs", read_log},
                                                         {"requests", read_request},
                                                         {"runs", read_run}};
  return all;
}

}  // namespace fuzz
