// The source files of the live page, from page/.
#pragma once

#include <string>
#include <string_view>

namespace harness {

std::string_view live_page_html();  // with places such as {{title}}
std::string_view live_page_css();
/// All scripts, one after the other.
std::string live_page_script();

}  // namespace harness
