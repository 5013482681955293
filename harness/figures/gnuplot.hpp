// Pictures for papers and pages, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "harness/figures/palette.hpp"
#include "harness/files/output_file.hpp"

namespace harness {

struct Picture {
  std::string name;      // file name without extension
  int width = 0;         // [px]
  int height = 0;        // [px]
  std::string settings;  // data and settings, in gnuplot's language
  std::string plot;      // the plot commands
};

/// Draws NAME.png and NAME.svg in this folder. Returns an error message, or nothing.
std::string draw_picture(const Picture& picture, const std::filesystem::path& folder);

/// Throws BadInput if NAME.png and NAME.svg may not be written there.
void check_picture(const std::filesystem::path& folder, const std::string& name, Existing existing);

/// The text in gnuplot's single quotes. Only the quote itself is special there.
std::string gnuplot_text(const std::string& text);

/// The colour as gnuplot reads it: in quotes, a number sign and six hexadecimal digits.
std::string gnuplot_colour(Rgb colour);

}  // namespace harness
