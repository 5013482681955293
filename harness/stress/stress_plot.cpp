#include "harness/stress/stress_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <system_error>

#include "harness/film/piped_program.hpp"
#include "harness/palette.hpp"

namespace harness {

namespace {

struct Terminal {
  const char* settings;
  const char* file;
};

constexpr Terminal terminals[] = {
    {"pngcairo size 1000,640 font 'DejaVu Sans,11' background 'white'", "time.png"},
    {"svg size 1000,640 font 'DejaVu Sans,11' background 'white'", "time.svg"}};

/// In gnuplot's single quotes, between which a quote is the only sign that means anything.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char sign : text) result += sign == '\'' ? "''" : std::string(1, sign);
  return result + "'";
}

Rgb colour_of(const std::string& stage) {
  if (stage == "physics step") return palette::sky_blue;
  if (stage == "scan") return palette::orange;
  if (stage == "rest") return palette::odometry;
  if (stage == "simulated second") return palette::truth;
  return colour_of_estimator(stage);
}

std::string data_of(const std::vector<StageScaling>& stages) {
  std::string text;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "$stage{} << EOD\n", i);
    for (std::size_t k = 0; k < stages[i].us.size(); ++k)
      fmt::format_to(std::back_inserter(text), "{} {}\n", stages[i].landmarks[k], stages[i].us[k]);
    text += "EOD\n";
  }
  return text;
}

std::string plot_of(const std::vector<StageScaling>& stages) {
  std::string text = "plot ";
  for (std::size_t i = 0; i < stages.size(); ++i) {
    fmt::format_to(std::back_inserter(text),
                   "{}$stage{} with linespoints pt 7 lw 2 lc rgb '#{:06x}' title {}", i == 0 ? "" : ", ", i,
                   colour_of(stages[i].name), quoted(stages[i].name));
  }
  return text + " noenhanced\n";
}

std::string script(const std::vector<StageScaling>& stages, const std::filesystem::path& folder) {
  std::string text = data_of(stages);
  text +=
      "set logscale xy\nset format x '%.0f'\nset grid lc '#e6e6e6' lt 1\nset border lc '#888888'\n"
      "set key outside right\nset xlabel 'landmarks'\nset ylabel 'median time [us]'\n";
  for (const Terminal& terminal : terminals) {
    // An absolute path: one that began with a bar would be a command.
    const std::filesystem::path file = std::filesystem::absolute(folder) / terminal.file;
    text += fmt::format("set terminal {}\nset output {}\n{}", terminal.settings, quoted(file.string()),
                        plot_of(stages));
  }
  return text + "set output\n";
}

}  // namespace

std::string draw_scaling(const std::vector<StageScaling>& stages, const std::filesystem::path& folder) {
  if (std::ranges::none_of(stages, [](const StageScaling& s) { return s.us.size() > 1; })) return {};
  const std::string path = std::filesystem::absolute(folder).string();
  if (std::ranges::any_of(path, [](char sign) { return sign >= 0 && sign < ' '; }))
    return "no plot: gnuplot cannot write to a folder with such a name";
  try {
    PipedProgram gnuplot({"gnuplot"});
    const std::string text = script(stages, folder);
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
