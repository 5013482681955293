// Fills in the places of a page's template.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace harness {

/// What stands in each place, by its name.
using TemplatePlaces = std::map<std::string_view, std::string>;

/// Replaces each {{name}} once; the inserted text is not searched again. Throws std::out_of_range for a place that has
/// no text.
std::string fill_template(std::string_view text, const TemplatePlaces& places);

}  // namespace harness
