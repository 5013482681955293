// A report page: one HTML file that includes everything it needs.
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
  std::string note = {};           // text below the table, if any
};

/// A long text, shown unchanged and folded by default.
struct Listing {
  std::string title = {};
  std::string text = {};
};

/// A picture that the page includes, from a file of the folder.
struct PageImage {
  std::string title = {};
  std::string caption = {};
  std::filesystem::path file;  // SVG or PNG
};

/// Something in words: a text, and facts below it.
struct Description {
  std::string title = {};
  std::string text = {};
  std::vector<Fact> facts = {};
};

struct Page {
  std::string title = {};
  std::vector<Fact> facts = {};
  std::string notes = {};                      // paragraphs, with an empty line between them
  std::vector<Table> tables = {};              // above the figures
  std::vector<Description> descriptions = {};  // above the figures
  std::vector<Table> details = {};             // below the figures
  std::vector<Figure> figures = {};
  std::vector<PageImage> images = {};
  std::vector<MatrixFigure> matrices = {};
  std::string matrices_note = {};
  std::optional<std::filesystem::path> film;  // MP4, WebM or GIF
  std::vector<Listing> listings = {};
};

/// A larger film is linked and not included in the page. [byte]
inline constexpr std::uintmax_t largest_film = 8'000'000;

/// The page as HTML. `file` is the later path of the page, for the link to a film that is too large to
/// include. `library` is the text of Chart.js. Throws std::system_error if the film cannot be read.
std::string to_html(const Page& page, const std::filesystem::path& file, std::string_view library);

/// Escapes text for HTML, and for attributes of HTML.
std::string escaped(std::string_view text);

}  // namespace harness
