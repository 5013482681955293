#include "harness/film/film_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string_view>

#include "harness/files/bad_input.hpp"
#include "harness/terminal/checks.hpp"
#include "worlds/film_layers.hpp"

namespace harness {

namespace {

constexpr std::string_view all = "all";
constexpr double fastest = 1e6;  // [-] simulated time over film time
constexpr double latest = 1e9;   // [s] the longest duration of a run

std::string layer_names() {
  std::string names;
  for (const worlds::FilmLayer& layer : worlds::film_layers) names += fmt::format(", {}", layer.name);
  return std::string(all) + names;
}

std::string size_override(const std::string& size) {
  const std::size_t cross = size.find('x');
  const std::string width = size.substr(0, cross);
  const std::string height = cross == std::string::npos ? "" : size.substr(cross + 1);
  const auto is_number = [](const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  };
  if (!is_number(width) || !is_number(height))
    throw BadInput(fmt::format("--size: expected width x height such as 1920x1080, not '{}'", size));
  return fmt::format("film.size_px=[{}, {}]", width, height);
}

/// Names are quoted because a name may look like a number.
std::string estimators_override(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
  return fmt::format("film.estimators=[{}]", list);
}

void switch_layers(const std::vector<std::string>& names, bool shown, std::vector<std::string>& overrides) {
  const auto switch_layer = [&](std::string_view name) {
    overrides.push_back(fmt::format("film.layers.{}={}", name, shown));
  };
  for (const std::string& name : names) {
    if (name != all) {
      switch_layer(name);
      continue;
    }
    for (const worlds::FilmLayer& layer : worlds::film_layers) switch_layer(layer.name);
  }
}

}  // namespace

void add_film_options(CLI::App& command, FilmOptions& options) {
  const auto add = [&](const char* name, auto& value, const char* type, const std::string& help) {
    return command.add_option(name, value, help)->type_name(type)->group("Film");
  };
  const auto add_list = [&](const char* name, std::vector<std::string>& names, const std::string& help) {
    add(name, names, "NAME,...", help)->delimiter(',')->allow_extra_args(false);
  };
  add("--out,-o", options.out, "FILE",
      "File to write: .mp4, .webm, .gif, or .png. Several estimators share one film. With .png and without "
      "--at there is a file for each frame: for film.png film_00000.png, film_00001.png, ...");
  add("--camera", options.camera, "NAME", "overview, chase, orbit, top or fixed");
  add("--size", options.size, "WxH", "Width and height [px], both even, such as 1920x1080");
  add("--fps", options.fps, "INT", "Frames for each second of the film")->check(whole_number(1, 240));
  add("--speed", options.speed, "FLOAT", "Simulated over film time; 0: the film takes 40 s at the most")
      ->check(number_between(0.0, fastest));
  const CLI::Validator time = number_between(0.0, latest);
  add("--from", options.from, "FLOAT", "Time after the start of the run at which the film begins [s]")
      ->check(time);
  add("--to", options.to, "FLOAT", "Time after the start of the run at which the film ends [s]")->check(time);
  add("--at", options.at, "FLOAT", "A single picture, this time after the start of the run [s]")->check(time);
  add_list("--estimators", options.estimators, "Film these, one or two");
  add_list("--show", options.show, "Show these layers, whatever is hidden: " + layer_names());
  add_list("--hide", options.hide, "Hide these layers");
}

std::vector<std::string> film_overrides(const FilmOptions& options) {
  std::vector<std::string> overrides;
  if (!options.camera.empty()) overrides.push_back("film.camera=" + options.camera);
  if (!options.size.empty()) overrides.push_back(size_override(options.size));
  if (options.fps) overrides.push_back(fmt::format("film.fps={}", *options.fps));
  if (options.speed) overrides.push_back(fmt::format("film.speed={}", *options.speed));
  if (!options.estimators.empty()) overrides.push_back(estimators_override(options.estimators));
  switch_layers(options.hide, false, overrides);
  switch_layers(options.show, true, overrides);
  return overrides;
}

}  // namespace harness
