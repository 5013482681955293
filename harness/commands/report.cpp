#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/figures/figure_plot.hpp"
#include "harness/figures/gnuplot.hpp"
#include "harness/files/output_file.hpp"
#include "harness/files/script_library.hpp"
#include "harness/report/pages.hpp"
#include "harness/terminal/messages.hpp"

namespace harness {

namespace {

struct ReportArguments {
  std::string folder;
  std::string out;      // empty: report.html in the folder
  std::string figures;  // folder for PNG and SVG; empty: write no figures
  std::string library;  // path of Chart.js; empty: where packages install it
  bool no_replay = false;
  bool force = false;
};

std::string library_of(const ReportArguments& arguments) {
  if (!arguments.library.empty()) return read_whole_file(arguments.library);
  try {
    return read_script(chart_js());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("report: {}; --chart-js FILE says where its chart.min.js is", error.what()));
  }
}

/// Throws BadInput if a figure may not be written there.
void check_figures(const Page& page, const std::filesystem::path& folder, Existing existing) {
  for (const Figure& figure : page.figures) check_picture(folder, figure.id, existing);
  for (const MatrixFigure& matrix : page.matrices) check_picture(folder, matrix.id, existing);
}

/// Draws each figure as PNG and SVG. If one cannot be drawn, prints a line to stderr and returns false.
bool draw_figures(const Page& page, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string complaint;
  for (const Figure& figure : page.figures) {
    if (complaint.empty()) complaint = draw(figure, folder);
  }
  for (const MatrixFigure& matrix : page.matrices) {
    if (complaint.empty()) complaint = draw(matrix, folder);
  }
  if (!complaint.empty()) tell_error(fmt::format("seifbed: {}", complaint));
  return complaint.empty();
}

int report(const ReportArguments& arguments, const seif::Registry& registry) {
  const std::filesystem::path folder = arguments.folder;
  const std::string library = library_of(arguments);
  const std::filesystem::path usual = folder / "report.html";
  const std::filesystem::path file = arguments.out.empty() ? usual : std::filesystem::path(arguments.out);
  const Existing others = arguments.force ? Existing::replace : Existing::keep;
  const bool is_usual = file.lexically_normal() == usual.lexically_normal();  // this page, made again
  const Existing existing = is_usual ? Existing::replace : others;
  check_output(file, existing);
  const Page page = page_of(folder, registry, !arguments.no_replay);
  if (!arguments.figures.empty()) check_figures(page, arguments.figures, others);
  write_whole_file(file, to_html(page, file, library), existing);
  const bool drawn = arguments.figures.empty() || draw_figures(page, arguments.figures);
  return print_all(fmt::format("Written to {}\n", file.string()), drawn ? 0 : 1);
}

}  // namespace

void add_report(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "report", "Write a page with everything about a run, a sweep, a comparison or a stress test");
  command->footer(
      "Examples:\n"
      "  seifbed report runs/courtyard-1\n"
      "  seifbed report runs/loop-1 --out loop.html --figures figures\n"
      "  seifbed report theta                    # the folder of a sweep\n"
      "  seifbed report runs/stress\n"
      "  seifbed report runs/paper               # the folder of seifbed paper, or of compare --out\n"
      "The page is one HTML file that needs no network: scores, plots to zoom into, the world.\n"
      "What it shows is described in docs/reports.md.");
  auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option("FOLDER", arguments->folder,
                   "Folder of a run, a replay, a sweep, a stress test, of paper, or of compare's --out")
      ->required();
  command->add_option("--out", arguments->out,
                      "File to write; by default report.html in the folder, where an older one is replaced");
  command->add_flag("--force", arguments->force, "Replace other files that are there already");
  command->add_option("--figures", arguments->figures, "Folder for each figure as PNG and SVG, by gnuplot");
  command->add_option("--chart-js", arguments->library,
                      "The file chart.min.js of Chart.js 3, where it is not from Debian's package");
  command->add_flag(
      "--no-replay", arguments->no_replay,
      "Leave out what only a replay of the run can tell: sparsity, NIS, NEES as seen from the robot");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return report(*arguments, registry); });
  });
}

}  // namespace harness
