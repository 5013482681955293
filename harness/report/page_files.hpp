// The files that pages are made of, as they stand in this folder.
#pragma once

#include <string_view>

namespace harness {

std::string_view page_html();  // with places such as {{title}}
std::string_view page_css();
std::string_view page_js();

}  // namespace harness
