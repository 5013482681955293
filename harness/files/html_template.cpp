#include "harness/files/html_template.hpp"

#include <cstddef>

namespace harness {

std::string fill_template(std::string_view text, const TemplatePlaces& places) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find("{{");
    if (begin == std::string_view::npos) return result.append(text);
    const std::size_t end = text.find("}}", begin);
    result.append(text.substr(0, begin)).append(places.at(text.substr(begin + 2, end - begin - 2)));
    text.remove_prefix(end + 2);
  }
}

}  // namespace harness
