// What a command line says about films.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace harness {

/// An empty value means that the option was not given.
struct FilmOptions {
  std::string out;                      // a file
  std::string camera;                   //
  std::string size;                     // [px] as in 1920x1080
  std::optional<int> fps;               // [1/s]
  std::optional<double> speed;          // [-] simulated over film time
  std::optional<double> from;           // [s] of simulated time
  std::optional<double> to;             // [s] of simulated time
  std::optional<double> at;             // [s] of simulated time: a single picture
  std::vector<std::string> estimators;  // names
  std::vector<std::string> show;        // layers, or "all"
  std::vector<std::string> hide;        // the same, but show counts
};

/// `options` must outlive the parsing.
void add_film_options(CLI::App& command, FilmOptions& options);

/// The options that are also keys of world files, as overrides `film.key=value`: the world's reader checks
/// them. Throws BadInput for an invalid size.
std::vector<std::string> film_overrides(const FilmOptions& options);

}  // namespace harness
