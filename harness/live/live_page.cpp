#include "harness/live/live_page.hpp"

#include "harness/files/html_template.hpp"
#include "harness/files/script_library.hpp"
#include "harness/live/live_page_files.hpp"

namespace harness {

namespace {

/// Text for HTML.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char sign : text) safe += sign == '<' ? "&lt;" : sign == '&' ? "&amp;" : std::string(1, sign);
  return safe;
}

}  // namespace

std::string live_page(const std::string& title) {
  return fill_template(live_page_html(), {{"title", plain(title)},
                                          {"css", std::string(live_page_css())},
                                          {"three", read_script(three_js())},
                                          {"orbit", read_script(orbit_controls())},
                                          {"chart", read_script(chart_js())},
                                          {"script", live_page_script()}});
}

}  // namespace harness
