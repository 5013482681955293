#include "harness/film/film_options.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/estimators/estimator_schemas.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "worlds/film_layers.hpp"
#include "worlds/load.hpp"

namespace harness {
namespace {

/// The options that a command with a positional argument reads from a command line.
FilmOptions parsed(const std::string& command_line) {
  CLI::App app;
  FilmOptions options;
  std::string run;
  app.add_option("RUN", run)->required();
  add_film_options(app, options);
  app.parse(command_line);
  EXPECT_EQ(run, "my_run") << command_line;
  return options;
}

/// A world of two estimators with these options.
worlds::LoadResult filmed(const std::string& command_line) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml", "estimators: {ekf: {}, seif: {}}\n");
  return worlds::load_world(folder / "world.yaml", film_overrides(parsed(command_line)),
                            estimator_schemas(known_estimators()));
}

worlds::Film film_of(const std::string& command_line) {
  const worlds::LoadResult result = filmed(command_line);
  for (const worlds::Problem& problem : result.problems) ADD_FAILURE() << worlds::to_string(problem);
  return result.world.value_or(worlds::World{}).film;
}

std::string problems_of(const std::string& command_line) {
  std::string text;
  for (const worlds::Problem& problem : filmed(command_line).problems)
    text += worlds::to_string(problem) + "\n";
  return text;
}

/// The layers that are shown.
std::string layers_of(const std::string& command_line) {
  const worlds::Film film = film_of(command_line);
  std::string names;
  for (const worlds::FilmLayer& layer : worlds::film_layers) {
    if (film.layers.*layer.shown) names += fmt::format("{} ", layer.name);
  }
  return names;
}

TEST(FilmOptions, SayNothingByThemselves) {
  EXPECT_TRUE(film_overrides(parsed("my_run")).empty());
  EXPECT_TRUE(film_overrides(parsed("my_run -o a.mp4 --from 1 --to 2 --at 3")).empty());
}

TEST(FilmOptions, ReachTheWorld) {
  const worlds::Film film =
      film_of("my_run --camera chase --size 640x360 --fps 25 --speed 2.5 --estimators seif,ekf");
  EXPECT_EQ(film.camera, worlds::FilmCamera::chase);
  EXPECT_EQ(film.width, 640);
  EXPECT_EQ(film.height, 360);
  EXPECT_EQ(film.fps, 25);
  EXPECT_EQ(film.speed, 2.5);
  EXPECT_EQ(film.estimators, (std::vector<std::string>{"seif", "ekf"}));
}

TEST(FilmOptions, KeepWhatIsNoPartOfAWorld) {
  const FilmOptions options = parsed("-o a.mp4 --from 1.5 --to 2 --at 3 my_run");
  EXPECT_EQ(options.out, "a.mp4");
  EXPECT_EQ(options.from, 1.5);
  EXPECT_EQ(options.to, 2.0);
  EXPECT_EQ(options.at, 3.0);
}

TEST(FilmOptions, NameTheFileAsOtherCommandsDo) {
  EXPECT_EQ(parsed("my_run --out a.mp4").out, "a.mp4");
  EXPECT_EQ(parsed("my_run -o a.mp4").out, "a.mp4");
}

TEST(FilmOptions, HideBeforeTheyShow) {
  EXPECT_EQ(layers_of("--hide all --show truth,ellipses my_run"), "truth ellipses ");
  EXPECT_EQ(layers_of("--show ellipses --show truth --hide all my_run"), "truth ellipses ");
  EXPECT_EQ(layers_of("--hide all my_run"), "");
  EXPECT_EQ(layers_of("--hide all --show all my_run"), layers_of("my_run"));
  EXPECT_EQ(layers_of("--hide rays,legend --hide grid my_run"),
            "shadows range truth odometry estimate landmarks ellipses errors active links matrix times "
            "pose_error caption ");
}

TEST(FilmOptions, AreCheckedAsPartOfTheWorld) {
  EXPECT_EQ(problems_of("my_run --hide elipses"),
            "--set film.layers.elipses=false: unknown key 'elipses' (did you mean 'ellipses'?)\n");
  EXPECT_NE(problems_of("my_run --show ray").find("did you mean 'rays'?"), std::string::npos);
  EXPECT_NE(problems_of("my_run --camera chsae").find("did you mean 'chase'?"), std::string::npos);
  EXPECT_NE(problems_of("my_run --estimators sief").find("did you mean 'seif'?"), std::string::npos);
  EXPECT_NE(problems_of("my_run --estimators a,b,c").find("at most 2 names"), std::string::npos);
  EXPECT_NE(problems_of("my_run --size 641x360").find("multiple of 2"), std::string::npos);
  EXPECT_THROW(problems_of("my_run --fps 0"), CLI::ValidationError);
  EXPECT_THROW(problems_of("my_run --speed -1"), CLI::ValidationError);
}

TEST(FilmOptions, RefuseASizeThatIsNone) {
  for (const char* size : {"640", "640x", "x360", "640x360x2", "wide", "6.4x3", "-640x360", "640 x 360"}) {
    FilmOptions options;
    options.size = size;
    EXPECT_THROW(film_overrides(options), BadInput) << size;
  }
}

TEST(FilmOptions, ExplainThemselvesWithEveryLayer) {
  CLI::App app;
  FilmOptions options;
  add_film_options(app, options);
  const std::string help = app.help();
  for (const worlds::FilmLayer& layer : worlds::film_layers)
    EXPECT_NE(help.find(layer.name), std::string::npos) << layer.name;
}

}  // namespace
}  // namespace harness
