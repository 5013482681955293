#include "harness/doctor/machine.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>

#include "harness/figures/piped_program.hpp"
#include "harness/files/script_library.hpp"
#include "harness/film/frame_sink.hpp"
#include "harness/recording/run_folder.hpp"
#include "sim/render/renderer.hpp"

namespace harness {

namespace {

constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;

std::string cores() {
  cpu_set_t usable;
  if (sched_getaffinity(0, sizeof usable, &usable) != 0) throw std::runtime_error("the system does not tell");
  return fmt::format("{} usable of {}", CPU_COUNT(&usable), sysconf(_SC_NPROCESSORS_ONLN));
}

/// The value of a line of /proc/meminfo, such as `MemTotal`. [byte]
double memory_of(const std::string& key) {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key + ':')) return 1024.0 * std::stod(line.substr(key.size() + 1));
  }
  throw std::runtime_error("the system does not tell");
}

std::string memory() {
  const double free = memory_of("MemAvailable");
  const std::string text =
      fmt::format("{:.1f} GiB, {:.1f} GiB of it free", memory_of("MemTotal") / gibibyte, free / gibibyte);
  constexpr double least = 0.25 * gibibyte;  // enough for a run of the gallery
  if (free < least) throw std::runtime_error(text + ": end other programs");
  return text;
}

/// Free disk space; throws if the folder is not writable or too full.
std::string room_in(const std::filesystem::path& folder) {
  const double free = static_cast<double>(std::filesystem::space(folder).available);
  const std::string text = fmt::format("{:.1f} GiB free in {}", free / gibibyte, folder.string());
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw std::runtime_error(text + ": it cannot be written to; choose another with --out or TMPDIR");
  constexpr double least = 0.05 * gibibyte;  // enough for some runs and their films
  if (free < least) throw std::runtime_error(text + ": make room");
  return text;
}

/// What a program writes to stderr for this input.
std::string words_of(const std::vector<std::string>& program, const std::string& input,
                     const std::string& package) {
  try {
    PipedProgram running(program);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(input.data());
    static_cast<void>(running.send(std::span(bytes, input.size())));
    static_cast<void>(running.finish());
    return running.complaint();
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    throw std::runtime_error(fmt::format("missing: install {} (Debian)", package));
  }
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string ffmpeg() {
  const std::string banner = first_line(words_of({"ffmpeg"}, "", "ffmpeg"));
  return banner.substr(0, banner.find(" Copyright"));
}

std::string gnuplot() {
  return "gnuplot " +
         first_line(
             words_of({"gnuplot"}, "print GPVAL_VERSION, ' patchlevel ', GPVAL_PATCHLEVEL\n", "gnuplot-nox"));
}

/// The size of a library of JavaScript, for reports and for the live page.
std::string script(const ScriptLibrary& library) {
  return fmt::format("{} kB", read_script(library).size() / 1000);
}

/// Tests an encoder: writes a film in this format.
std::string encoder(const std::string& extension) {
  constexpr int side = 64;  // [px]
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / ("film" + extension);
  const std::unique_ptr<FrameSink> sink = make_frame_sink(file, {side, side, 10}, false);
  const render::Image frame{side, side, std::vector<std::uint8_t>(3 * side * side, 128)};
  for (int i = 0; i < 3; ++i) sink->write(frame);
  sink->finish();
  return fmt::format("writes {}", extension);
}

std::string graphics() { return render::Renderer(64, 64).description(); }

}  // namespace

std::vector<Finding> look_at_machine() {
  std::vector<Finding> found = {
      finding("cores", cores),
      finding("memory", memory),
      finding("folder of runs", [] { return room_in(std::filesystem::current_path()); }),
      finding("temporary folder", [] { return room_in(std::filesystem::temp_directory_path()); }),
      finding("OSMesa", graphics),
      finding("ffmpeg", ffmpeg),
  };
  if (found.back().is_good) {
    for (const auto& [name, extension] : std::array<std::pair<const char*, const char*>, 3>{
             {{"H.264 encoder", ".mp4"}, {"VP9 encoder", ".webm"}, {"GIF encoder", ".gif"}}})
      found.push_back(finding(name, [&, file = std::string(extension)] { return encoder(file); }));
  }
  found.push_back(finding("gnuplot", gnuplot));
  found.push_back(finding("Chart.js", [] { return script(chart_js()); }));
  found.push_back(finding("three.js", [] { return script(three_js()) + ", " + script(orbit_controls()); }));
  return found;
}

}  // namespace harness
