#include "harness/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/files/base64.hpp"
#include "harness/files/html_template.hpp"
#include "harness/files/output_file.hpp"
#include "harness/film/poster.hpp"
#include "harness/report/page_files.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

std::string facts_html(const std::vector<Fact>& facts) {
  std::string html = "<dl>\n";
  for (const Fact& fact : facts)
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(fact.name), escaped(fact.value));
  return html + "</dl>";
}

std::string description_html(const Description& description) {
  const std::string text =
      description.text.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(description.text));
  return fmt::format("<section class=\"description\">\n<h2>{}</h2>\n{}{}</section>\n",
                     escaped(description.title), text, facts_html(description.facts));
}

std::string notes_html(std::string_view notes) {
  std::string html;
  while (!notes.empty()) {
    const std::size_t end = std::min(notes.find("\n\n"), notes.size());
    std::string_view paragraph = notes.substr(0, end);
    notes.remove_prefix(std::min(end + 1, notes.size()));
    while (paragraph.starts_with('\n')) paragraph.remove_prefix(1);
    while (paragraph.ends_with('\n')) paragraph.remove_suffix(1);
    if (!paragraph.empty()) html += fmt::format("<p>{}</p>\n", escaped(paragraph));
  }
  return html.empty() ? html : fmt::format("<section class=\"notes\">\n<h2>Notes</h2>\n{}</section>\n", html);
}

std::string row_html(const TextRow& row, const char* first, const char* other) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string_view tag = i == 0 ? first : other;
    html += fmt::format("<{}>{}</{}>", tag, escaped(row[i]), tag.substr(0, 2));
  }
  return html + "</tr>\n";
}

std::string table_html(const Table& table) {
  std::string html = fmt::format(
      "<section>\n<h2>{0}</h2>\n<div class=\"wide\"><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"{0}\"><table>\n",
      escaped(table.title));
  html += "<thead>\n" + row_html(table.rows.front(), "th scope=\"col\"", "th scope=\"col\"") +
          "</thead>\n<tbody>\n";
  for (std::size_t i = 1; i < table.rows.size(); ++i)
    html += row_html(table.rows[i], "th scope=\"row\"", "td");
  html += "</tbody>\n</table></div></div>\n";
  if (!table.note.empty()) html += fmt::format("<p>{}</p>\n", escaped(table.note));
  return html + "</section>\n";
}

std::string figure_html(const Figure& figure) {
  return fmt::format(
      "<section>\n<h2>{}</h2>\n<figure>\n<div class=\"plot{}\" id=\"{}\"></div>\n"
      "<figcaption><p>{}</p></figcaption>\n</figure>\n</section>\n",
      escaped(figure.title), figure.is_map ? " map" : "", escaped(figure.id), escaped(figure.caption));
}

std::string matrices_html(const Page& page) {
  if (page.matrices.empty() && page.matrices_note.empty()) return {};
  std::string html = fmt::format("<section>\n<h2>Sparsity</h2>\n<p>{}</p>\n<div class=\"matrices\">\n",
                                 escaped(page.matrices_note));
  for (const MatrixFigure& matrix : page.matrices) {
    html += fmt::format(
        "<figure><canvas id=\"{}\" role=\"img\" "
        "aria-label=\"{}\"></canvas><figcaption>{}<p>{}</p></figcaption>"
        "</figure>\n",
        escaped(matrix.id), escaped(matrix.title), escaped(matrix.title), escaped(matrix.caption));
  }
  return html + "</div>\n</section>\n";
}

/// A path as part of a URL.
std::string url_of(const std::filesystem::path& path) {
  std::string url;
  for (const char sign : path.generic_string()) {
    const bool is_plain = (sign >= 'a' && sign <= 'z') || (sign >= 'A' && sign <= 'Z') ||
                          (sign >= '0' && sign <= '9') ||
                          std::string_view("-._~/").find(sign) != std::string_view::npos;
    url += is_plain ? std::string(1, sign) : fmt::format("%{:02X}", static_cast<unsigned char>(sign));
  }
  return url;
}

std::string data_url(const std::string& type, const std::string& bytes) {
  return "data:" + type + ";base64," +
         base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

/// The picture of a video that has not been started; its first frame would show an empty map.
std::string poster_html(const std::filesystem::path& film) {
  const std::string bytes = poster_of(film);
  return bytes.empty() ? std::string() : fmt::format(" poster=\"{}\"", data_url("image/jpeg", bytes));
}

std::string film_html(const std::optional<std::filesystem::path>& film, const std::filesystem::path& file) {
  if (!film) return {};
  const std::filesystem::path extension = film->extension();
  const bool is_gif = extension == ".gif";
  const std::string type = is_gif ? "image/gif" : extension == ".webm" ? "video/webm" : "video/mp4";
  std::string source = url_of(
      std::filesystem::absolute(*film).lexically_relative(std::filesystem::absolute(file).parent_path()));
  const std::string link =
      fmt::format("<p><a href=\"{}\">{}</a></p>\n", source, escaped(film->filename().string()));
  if (std::filesystem::file_size(*film) < largest_film) source = data_url(type, read_whole_file(*film));
  const std::string element =
      is_gif ? fmt::format("<img class=\"film\" src=\"{}\" alt=\"The film of the run\">", source)
             : fmt::format("<video controls playsinline preload=\"metadata\"{} src=\"{}\"></video>",
                           poster_html(*film), source);
  return "<section>\n<h2>Film</h2>\n" + element + '\n' + link + "</section>\n";
}

std::string image_html(const PageImage& image) {
  const std::string bytes = read_whole_file(image.file);
  return fmt::format(
      "<section>\n<h2>{0}</h2>\n<figure>\n<img class=\"film\" alt=\"{0}\" "
      "src=\"data:image/{1};base64,{2}\">\n"
      "<figcaption><p>{3}</p></figcaption>\n</figure>\n</section>\n",
      escaped(image.title), image.file.extension() == ".svg" ? "svg+xml" : "png",
      base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}), escaped(image.caption));
}

std::string listing_html(const Listing& listing) {
  return fmt::format("<details><summary>{}</summary>\n<pre>{}</pre></details>\n", escaped(listing.title),
                     escaped(listing.text));
}

/// JSON for a script element. Only "</script" and "<!--" could end the element.
std::string data_json(const Page& page) {
  const auto list = [](const auto& figures) {
    std::string json;
    for (const auto& figure : figures) json += (json.empty() ? "" : ",\n") + to_json(figure);
    return '[' + json + ']';
  };
  const std::string json =
      fmt::format("{{\"figures\":{},\n\"matrices\":{}}}", list(page.figures), list(page.matrices));
  std::string safe;
  for (const char sign : json) safe += sign == '<' ? "\\u003c" : std::string(1, sign);
  return safe;
}

template <class Items, class ToHtml>
std::string joined(const Items& items, const ToHtml& to_html) {
  std::string html;
  for (const auto& item : items) html += to_html(item);
  return html;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char sign : text) {
    switch (sign) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += sign;
    }
  }
  return result;
}

std::string to_html(const Page& page, const std::filesystem::path& file, std::string_view library) {
  return fill_template(page_html(), {{"title", escaped(page.title)},
                                     {"style", std::string(page_css())},
                                     {"facts", facts_html(page.facts)},
                                     {"notes", notes_html(page.notes)},
                                     {"tables", joined(page.tables, table_html)},
                                     {"descriptions", joined(page.descriptions, description_html)},
                                     {"details", joined(page.details, table_html)},
                                     {"figures", joined(page.figures, figure_html)},
                                     {"images", joined(page.images, image_html)},
                                     {"matrices", matrices_html(page)},
                                     {"film", film_html(page.film, file)},
                                     {"listings", joined(page.listings, listing_html)},
                                     {"version", escaped(program_version())},
                                     {"data", data_json(page)},
                                     {"library", std::string(library)},
                                     {"script", std::string(page_js())}});
}

}  // namespace harness
