// The film options of the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace harness {

/// The options as given. An empty value was not given.
struct FilmOptions {
  std::string out;                      // file name
  std::string camera;                   //
  std::string size;                     // [px], for instance 1920x1080
  std::optional<int> fps;               // [1/s]
  std::optional<double> speed;          // [-] simulated time over film time
  std::optional<double> from;           // [s] of simulated time
  std::optional<double> to;             // [s] of simulated time
  std::optional<double> at;             // [s] of simulated time: draws a single picture
  std::vector<std::string> estimators;  // names
  std::vector<std::string> show;        // layers, or "all"
  std::vector<std::string> hide;        // layers; `show` has precedence
};

/// Adds the film options to a command. `options` must live until the command line is parsed.
void add_film_options(CLI::App& command, FilmOptions& options);

/// The options that world files have too, as overrides `film.key=value`; the reader of the world file checks
/// them. Throws BadInput if the size is malformed.
std::vector<std::string> film_overrides(const FilmOptions& options);

}  // namespace harness
