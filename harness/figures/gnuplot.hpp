// Pictures for papers and pages, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "harness/figures/palette.hpp"

namespace harness {

struct Picture {
  std::string name;      // of its files, without extension
  int width = 0;         // [px]
  int height = 0;        // [px]
  std::string settings;  // data and settings, in gnuplot's language
  std::string plot;      // what draws it
};

/// Draws NAME.png and NAME.svg in this folder. What went wrong, or nothing.
std::string draw_picture(const Picture& picture, const std::filesystem::path& folder);

/// In gnuplot's single quotes, between which a quote is the only sign that means anything.
std::string gnuplot_text(const std::string& text);

/// As gnuplot writes a colour: six hexadecimal digits after a hash, between single quotes.
std::string gnuplot_colour(Rgb colour);

}  // namespace harness
