#include "harness/figures/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <system_error>

#include "harness/figures/piped_program.hpp"

namespace harness {

namespace {

struct Terminal {
  const char* name;
  const char* extension;
};

constexpr Terminal terminals[] = {{"pngcairo", "png"}, {"svg", "svg"}};

std::string script(const Picture& picture, const std::filesystem::path& folder) {
  std::string text = picture.settings;
  for (const Terminal& terminal : terminals) {
    // An absolute path: gnuplot would take a name that begins with a bar for a command.
    const std::filesystem::path file =
        std::filesystem::absolute(folder) / fmt::format("{}.{}", picture.name, terminal.extension);
    text +=
        fmt::format("set terminal {} size {},{} font 'DejaVu Sans,11' background 'white'\nset output {}\n{}",
                    terminal.name, picture.width, picture.height, gnuplot_text(file.string()), picture.plot);
  }
  return text + "set output\n";
}

}  // namespace

void check_picture(const std::filesystem::path& folder, const std::string& name, Existing existing) {
  for (const Terminal& terminal : terminals)
    check_output(folder / fmt::format("{}.{}", name, terminal.extension), existing);
}

std::string gnuplot_text(const std::string& text) {
  std::string result = "'";
  for (const char sign : text) result += sign == '\'' ? "''" : std::string(1, sign);
  return result + "'";
}

std::string gnuplot_colour(Rgb colour) { return fmt::format("'#{:06x}'", colour); }

std::string draw_picture(const Picture& picture, const std::filesystem::path& folder) {
  const std::string path = std::filesystem::absolute(folder).string();
  if (std::ranges::any_of(path, [](char sign) { return sign >= 0 && sign < ' '; }))
    return "no plot: gnuplot cannot write to a folder with such a name";
  try {
    PipedProgram gnuplot({"gnuplot"});
    const std::string text = script(picture, folder);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    if (gnuplot.send(std::span(bytes, text.size())) && gnuplot.finish()) return {};
    static_cast<void>(gnuplot.finish());
    return fmt::format("no plot: gnuplot says: {}", gnuplot.complaint());
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    return "no plot: gnuplot is missing (Debian's package gnuplot-nox)";
  }
}

}  // namespace harness
