// The source files of pages, from this folder.
#pragma once

#include <string_view>

namespace harness {

std::string_view page_html();  // with placeholders such as {{title}}
std::string_view page_css();
std::string_view page_js();

}  // namespace harness
