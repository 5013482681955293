// worlds/report2002.yaml, as it was when the program was built: the program finds it wherever it is called.
#pragma once

#include <string_view>

namespace harness {

/// The text of the file.
std::string_view report_world();

}  // namespace harness
