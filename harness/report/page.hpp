// A page: one HTML file with everything that it needs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/files/text_table.hpp"

namespace harness {

struct Fact {
  std::string name = {};
  std::string value = {};
};

struct Table {
  std::string title = {};
  std::vector<TextRow> rows = {};  // the first is the header
  std::string note = {};           // below; empty: none
};

/// A long text, unchanged, folded away.
struct Listing {
  std::string title = {};
  std::string text = {};
};

struct Page {
  std::string title = {};
  std::vector<Fact> facts = {};
  std::vector<Table> tables = {};   // above the figures
  std::vector<Table> details = {};  // below them
  std::vector<Figure> figures = {};
  std::vector<MatrixFigure> matrices = {};
  std::string matrices_note = {};
  std::optional<std::filesystem::path> film;  // MP4, WebM or GIF
  std::vector<Listing> listings = {};
};

/// Larger films are linked instead of embedded. [byte]
inline constexpr std::uintmax_t largest_film = 8'000'000;

/// `file` is where the page will be, for the link to a film that is too large for it; `library` the text of
/// Chart.js. Throws std::system_error if the film cannot be read.
std::string to_html(const Page& page, const std::filesystem::path& file, std::string_view library);

/// Text as text in HTML, and in its attributes.
std::string escaped(std::string_view text);

}  // namespace harness
