// The content of films, checked to the pixel, with a filter whose belief the test sets.
#include "harness/film/film.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "harness/film/film_folder.hpp"
#include "harness/film/paint.hpp"
#include "harness/fixtures.hpp"
#include "harness/run/prepared_run.hpp"

namespace harness {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Stores the frames.
class Frames final : public FrameSink {
 public:
  explicit Frames(std::vector<render::Image>& frames) : frames_(frames) {}
  void write(const render::Image& frame) override { frames_.push_back(frame); }
  void finish() override {}

 private:
  std::vector<render::Image>& frames_;
};

class BrokenSink final : public FrameSink {
 public:
  void write(const render::Image&) override { throw std::runtime_error("the disk is full"); }
  void finish() override {}
};

/// Believes in three landmarks, whatever it sees. The first and the last have a link.
class Dogmatist : public seif::Estimator {
 public:
  explicit Dogmatist(const seif::EstimatorSetup& setup) : pose_(setup.start.mean) {}

  static const std::vector<seif::LandmarkEstimate>& belief() {
    static const std::vector<seif::LandmarkEstimate> map = {
        {0, {-3.0, -2.0}}, {1, {0.0, 3.0}}, {2, {3.0, -1.0}}};
    return map;
  }
  static Matrix2d covariance() { return (Matrix2d() << 0.16, 0.10, 0.10, 0.12).finished(); }

  void motion_update(const seif::Odometry& odometry) override { pose_ = pose_ * odometry.T_previous_current; }
  void measurement_update(const seif::Scan&, const seif::StageDone&) override {}
  seif::Pose2 pose() const override { return pose_; }
  seif::Counts counts() const override { return {.links = 1}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override { return belief(); }
  seif::BeliefMatrix belief_matrix() const override { return seif::BeliefMatrix::information; }
  void couplings(seif::LandmarkId of, std::vector<seif::Coupling>& out) const override {
    out.clear();
    if (of == 0) out.push_back({2, 0.9});
    if (of == 2) out.push_back({0, 0.9});
  }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId> landmarks) const override {
    return seif::MarginalCovariances{1e-4 * Eigen::Matrix3d::Identity(),
                                     std::vector<Matrix2d>(landmarks.size(), covariance())};
  }

 private:
  seif::Pose2 pose_;
};

/// Has three links of landmarks, the last of them weak. Only the first and the last landmark are active.
class Linked final : public Dogmatist {
 public:
  using Dogmatist::Dogmatist;
  void couplings(seif::LandmarkId of, std::vector<seif::Coupling>& out) const override {
    out.clear();
    if (of == seif::no_landmark) out = {{0, 0.5}, {2, 0.5}};
    if (of == 0) out = {{1, 0.2}, {2, 0.2}};
    if (of == 1) out = {{0, 0.2}, {2, 0.02}};
    if (of == 2) out = {{0, 0.2}, {1, 0.02}};
  }
};

/// Has names of its own: the first landmark is the last one of the world.
class Renaming final : public Dogmatist {
 public:
  using Dogmatist::Dogmatist;
  bool needs_names() const override { return false; }
  std::span<const seif::LandmarkId> associations() const override { return names_; }
  void measurement_update(const seif::Scan& scan, const seif::StageDone&) override {
    names_.clear();
    for (std::size_t i = scan.observations.size(); i-- > 0;) names_.push_back(static_cast<int>(i));
  }
  std::vector<seif::LandmarkEstimate> map() const override {
    std::vector<seif::LandmarkEstimate> map = belief();
    std::swap(map[0].mean, map[2].mean);
    return map;
  }

 private:
  std::vector<seif::LandmarkId> names_;
};

seif::Registry registry() {
  seif::Registry registry = test::test_registry();
  seif::EstimatorType type;
  type.name = "dogmatist";
  type.make = [](const seif::EstimatorSetup& setup, const seif::Options&) {
    return std::make_unique<Dogmatist>(setup);
  };
  registry.add(type);
  type.name = "linked";
  type.make = [](const seif::EstimatorSetup& setup, const seif::Options&) {
    return std::make_unique<Linked>(setup);
  };
  registry.add(type);
  type.name = "renaming";
  type.make = [](const seif::EstimatorSetup& setup, const seif::Options&) {
    return std::make_unique<Renaming>(setup);
  };
  registry.add(std::move(type));
  return registry;
}

worlds::EstimatorChoice of_type(const std::string& type) {
  worlds::EstimatorChoice choice;
  choice.name = type;
  choice.type = type;
  return choice;
}

worlds::EstimatorChoice dogmatist() { return of_type("dogmatist"); }

/// A world seen from straight above by a camera at the origin, with only the layers that the test asks for.
worlds::World bare_world(double duration) {
  worlds::World world;
  world.name = "bare";
  world.duration = duration;
  world.robot.start = {{0.0, 0.0}, 0.0};
  for (const seif::LandmarkEstimate& landmark : Dogmatist::belief())
    world.landmarks.push_back({landmark.mean, 0.01});
  world.estimators = {dogmatist()};
  world.film.width = 640;
  world.film.height = 640;
  world.film.fps = 10;
  world.film.speed = 1.0;
  world.film.camera = worlds::FilmCamera::top;
  world.film.layers = {.grid = false,
                       .shadows = false,
                       .rays = false,
                       .range = false,
                       .truth = false,
                       .odometry = false,
                       .estimate = false,
                       .landmarks = false,
                       .ellipses = false,
                       .errors = false,
                       .active = false,
                       .links = false,
                       .matrix = false,
                       .times = false,
                       .pose_error = false,
                       .caption = false,
                       .legend = false};
  return world;
}

/// Films a world while it runs.
std::vector<render::Image> film_live(const worlds::World& world, const std::filesystem::path& folder,
                                     double from = 0.0) {
  std::filesystem::create_directories(folder);
  PreparedRun run = prepare_run(world, registry());
  run.plan.folder = folder;
  run.plan.quiet = true;
  std::vector<render::Image> frames;
  FilmPlan plan = film_plan(world);
  plan.clock.start = from;
  Film film(plan, *run.log, *run.believers, std::make_unique<Frames>(frames));
  execute(run, &film);
  film.finish(true);
  return frames;
}

/// The pixel at which the camera of bare_world() shows a point of the ground. [px]
Vector2d pixel_of(const worlds::World& world, const Vector2d& p_world) {
  const double pixels_per_metre = world.film.height / (3.0 * world.landmark_sensor.max_range);
  return {0.5 * world.film.width + pixels_per_metre * p_world.x(),
          0.5 * world.film.height - pixels_per_metre * p_world.y()};
}

using Rgb8 = std::array<int, 3>;

Rgb8 colour_at(const render::Image& image, int x, int y) {
  const std::uint8_t* const pixel = image.pixel(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

/// The largest difference of a pixel near a place from the colour of the bare ground. [-] of 255
int contrast(const render::Image& image, const Vector2d& pixel, const Rgb8& ground) {
  int most = 0;
  const int x = static_cast<int>(std::floor(pixel.x()));
  const int y = static_cast<int>(std::floor(pixel.y()));
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      const Rgb8 colour = colour_at(image, x + dx, y + dy);
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(colour[c] - ground[c]));
    }
  }
  return most;
}

/// The colour of the ground at an empty place.
Rgb8 ground_of(const worlds::World& world, const render::Image& image) {
  const Vector2d pixel = pixel_of(world, {-6.0, 6.0});
  return colour_at(image, static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
}

class FilmTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(FilmTest, ShowsALinkBetweenTheLandmarksThatHaveIt) {
  worlds::World world = bare_world(0.4);
  world.film.layers.links = true;
  const std::vector<render::Image> frames = film_live(world, folder_ / "run");
  const render::Image& last = frames.back();
  const Rgb8 ground = ground_of(world, last);
  const auto midway = [&](int a, int b, double share) {
    const auto& map = Dogmatist::belief();
    return pixel_of(world, (1.0 - share) * map[static_cast<std::size_t>(a)].mean +
                               share * map[static_cast<std::size_t>(b)].mean);
  };
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    EXPECT_GT(contrast(last, midway(0, 2, share), ground), 40) << share;
    EXPECT_LT(contrast(last, midway(0, 1, share), ground), 8) << share;
    EXPECT_LT(contrast(last, midway(1, 2, share), ground), 8) << share;
  }
}

TEST_F(FilmTest, FadesLinksThatAreWeakOrOld) {
  worlds::World world = bare_world(0.4);
  world.film.layers.links = true;
  world.estimators = {of_type("linked")};
  const render::Image last = film_live(world, folder_ / "run").back();
  const Rgb8 ground = ground_of(world, last);
  const auto darkness = [&](std::size_t a, std::size_t b) {
    const auto& map = Dogmatist::belief();
    return contrast(last, pixel_of(world, 0.5 * (map[a].mean + map[b].mean)), ground);
  };
  const int fresh = darkness(0, 2);
  const int old = darkness(0, 1);
  const int old_and_weak = darkness(1, 2);
  EXPECT_GT(fresh, 45);
  EXPECT_LT(old, fresh - 25);
  EXPECT_GT(old, 15);
  EXPECT_LT(old_and_weak, 8);
}

TEST_F(FilmTest, DrawsEllipsesOfTwoStandardDeviations) {
  worlds::World world = bare_world(0.4);
  world.film.layers.ellipses = true;
  world.film.width = world.film.height = 1280;  // the outline is then thin
  const std::vector<render::Image> frames = film_live(world, folder_ / "run");
  const render::Image& last = frames.back();
  const Rgb8 ground = ground_of(world, last);
  const Matrix2d L = Dogmatist::covariance().llt().matrixL();
  for (const seif::LandmarkEstimate& landmark : Dogmatist::belief()) {
    for (double angle = 0.0; angle < 6.28; angle += 0.1) {
      const Vector2d direction(std::cos(angle), std::sin(angle));
      const auto at = [&](double sigmas) {
        return contrast(last, pixel_of(world, landmark.mean + sigmas * (L * direction)), ground);
      };
      EXPECT_GT(at(2.0), 60) << landmark.landmark << " outline at " << angle;
      EXPECT_LT(at(2.5), 8) << landmark.landmark << " outside at " << angle;
      EXPECT_GT(at(1.5), 10) << landmark.landmark << " inside at " << angle;
      EXPECT_LT(at(1.5), 60) << landmark.landmark << " inside at " << angle;
    }
  }
}

/// An error goes from a landmark of the map to the one of the world that was seen, whatever their names are: here all are
/// zero.
TEST_F(FilmTest, DrawsNoErrorBetweenLandmarksThatOnlyBearTheSameName) {
  worlds::World world = bare_world(0.4);
  world.landmark_sensor.ids = worlds::LandmarkIds::hidden;
  world.film.layers.errors = true;
  world.estimators = {of_type("renaming")};
  const render::Image last = film_live(world, folder_ / "run").back();
  const Rgb8 ground = ground_of(world, last);
  const auto& map = Dogmatist::belief();
  for (const double share : {0.2, 0.4, 0.6, 0.8})
    EXPECT_LT(contrast(last, pixel_of(world, (1.0 - share) * map[0].mean + share * map[2].mean), ground), 8);
}

TEST_F(FilmTest, ShowsEachEstimatorInAViewOfItsOwn) {
  worlds::World world = bare_world(0.4);
  world.estimators = {test::choice("ekf"), dogmatist()};
  world.film.estimators = {"dogmatist", "ekf"};
  world.film.width = 1280;
  world.film.layers.links = true;
  const render::Image last = film_live(world, folder_ / "run").back();
  const auto& map = Dogmatist::belief();
  worlds::World half = world;
  half.film.width = 640;
  const Vector2d left = pixel_of(half, 0.5 * (map[0].mean + map[2].mean));
  const Rgb8 ground = ground_of(half, last);
  EXPECT_GT(contrast(last, left, ground), 40);
  EXPECT_LT(contrast(last, left + Vector2d(640.0, 0.0), ground), 8);
}

TEST_F(FilmTest, ShowsWallsAndGroundOfAnotherFriction) {
  worlds::World world = bare_world(0.4);
  world.walls = {{.points = {{-6.0, -5.0}, {-6.0, 5.0}}}};
  world.boxes = {{.centre = {{-5.0, -4.0}, 0.0}, .size = {1.0, 1.0}, .height = 0.5}};
  world.physics.patches = {{.min = {4.0, 2.0}, .max = {6.0, 4.0}}};
  const std::vector<render::Image> frames = film_live(world, folder_ / "run");
  const Rgb8 ground = colour_at(frames.back(), 5, 5);
  EXPECT_GT(contrast(frames.back(), pixel_of(world, {-6.0, 0.0}), ground), 60) << "a wall's top, from above";
  EXPECT_GT(contrast(frames.back(), pixel_of(world, {-5.0, -4.0}), ground), 40) << "a box's top";
  EXPECT_GT(contrast(frames.back(), pixel_of(world, {5.0, 3.0}), ground), 8);
  EXPECT_LT(contrast(frames.back(), pixel_of(world, {5.0, -3.0}), ground), 8);
}

TEST_F(FilmTest, HasAFrameForEachStepOfSimulatedTime) {
  worlds::World world = bare_world(2.0);
  EXPECT_EQ(film_live(world, folder_ / "a").size(), 21U);
  world.film.speed = 4.0;
  EXPECT_EQ(film_live(world, folder_ / "b").size(), 6U);
}

TEST_F(FilmTest, MovesTheRobotBetweenTheMeasurements) {
  worlds::World world = bare_world(2.5);
  world.film.width = world.film.height = 200;
  world.film.fps = 120;  // six frames to one odometry reading
  world.film.camera = worlds::FilmCamera::fixed;
  world.film.eye = {0.5, 0.0, 6.0};
  world.film.target = {0.5, 0.0, 0.0};
  world.drive.mode = worlds::DriveMode::waypoints;
  world.drive.path = {{5.0, 0.0}};
  const std::vector<render::Image> frames = film_live(world, folder_ / "run", 2.0);
  ASSERT_EQ(frames.size(), 61U);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_NE(frames[i].rgb, frames[i - 1].rgb) << i;
}

TEST_F(FilmTest, FitsAnOverviewToThePath) {
  worlds::World world = bare_world(0.4);
  world.landmark_sensor.max_range = 4.0;
  world.landmarks.push_back({{200.0, 0.0}, 0.01});  // never seen
  PreparedRun run = prepare_run(world, registry());
  const Stage whole(world, true, *run.log, {});
  const Stage fitted(world, true, *run.log, Area{{-1.0, -2.0}, {10.0, 2.0}});
  EXPECT_EQ(whole.subject().max.x(), 200.5);
  EXPECT_EQ(fitted.subject().max.x(), 14.0);
  EXPECT_EQ(fitted.subject().min, whole.subject().min) << "and not more than the world";
  const Stage outside(world, true, *run.log, Area{{-50.0, 0.0}, {10.0, 0.0}});
  EXPECT_EQ(outside.subject().min.x(), -50.5) << "but the whole path";
}

TEST_F(FilmTest, KnowsThePathThatIsToCome) {
  test::write_file(
      folder_ / "truth.csv",
      "t,x,y,theta,left_wheel,right_wheel\n0,0,9,0,0,0\n1,1,0,0,0,0\n2,2,-1,0,0,0\n3,3,5,0,0,0\n");
  const std::optional<Area> all = path_area(folder_.path(), 0.0, 9.0);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->min, Vector2d(0.0, -1.0));
  EXPECT_EQ(all->max, Vector2d(3.0, 9.0));
  const std::optional<Area> part = path_area(folder_.path(), 1.5, 2.5);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->min, Vector2d(1.0, -1.0));
  EXPECT_EQ(part->max, Vector2d(2.0, 0.0));
  EXPECT_FALSE(path_area(folder_ / "nowhere", 0.0, 1.0));
}

TEST_F(FilmTest, DrawsTheRobotLargeEnoughToBeSeen) {
  worlds::World world = bare_world(0.4);
  world.film.camera = worlds::FilmCamera::fixed;
  world.film.eye = {0.0, 0.0, 300.0};
  world.ground_size = {400.0, 400.0};
  world.film.target = {0.0, 0.0, 0.0};
  const render::Image last = film_live(world, folder_ / "run").back();
  const Rgb8 ground = colour_at(last, 200, 200);
  for (const int dx : {-3, 0, 3}) EXPECT_GT(contrast(last, {320.0 + dx, 320.0}, ground), 60) << dx;
  for (const int dx : {-40, 40}) EXPECT_LT(contrast(last, {320.0 + dx, 320.0}, ground), 8) << dx;
}

TEST_F(FilmTest, IsTheSameLiveAndFromTheFolder) {
  worlds::World world = test::small_world();
  world.duration = 6.0;
  world.estimators = {test::choice("ekf"), test::choice("seif")};
  world.film.width = 640;
  world.film.height = 360;
  world.film.fps = 5;
  world.film.speed = 2.0;
  const std::vector<render::Image> live = film_live(world, folder_ / "run");

  PreparedRun replayed = prepare_replay(folder_ / "run", world, registry());
  std::vector<render::Image> frames;
  FilmableFolder filmable{std::move(replayed), film_plan(world)};
  const FilmResult result = film_folder(filmable, folder_ / "run", std::make_unique<Frames>(frames), true);
  EXPECT_EQ(result.frames, 16);
  ASSERT_EQ(frames.size(), live.size());
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].rgb, live[i].rgb) << "frame " << i;
}

TEST_F(FilmTest, ThatCannotBeWrittenDoesNotEndTheRun) {
  const worlds::World world = bare_world(2.0);
  PreparedRun run = prepare_run(world, registry());
  run.plan.folder = folder_.path();
  run.plan.quiet = true;
  Film film(film_plan(world), *run.log, *run.believers, std::make_unique<BrokenSink>());
  const RunResult result = execute(run, &film);
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.summary.updates, 10);
  EXPECT_THROW(film.finish(true), std::runtime_error);
}

TEST_F(FilmTest, GoesOnWhenAnEstimatorFails) {
  worlds::World world = bare_world(2.0);
  worlds::EstimatorChoice failing = test::choice("dead_reckoning");
  failing.options["fail_after_scans"] = std::int64_t{3};
  world.estimators = {failing};
  world.film.layers = {};
  const std::vector<render::Image> frames = film_live(world, folder_ / "run");
  ASSERT_EQ(frames.size(), 21U);
  EXPECT_NE(frames[2].rgb, frames[20].rgb);  // the title says so
}

TEST_F(FilmTest, ShowsALogOfWhichNothingElseIsKnown) {
  worlds::World world = test::small_world();
  world.duration = 4.0;
  test::run_live(world, folder_ / "run");
  for (const char* known : {"world.yaml", "truth.csv", "landmarks.csv"})
    std::filesystem::remove(folder_ / "run" / known);
  std::vector<worlds::Problem> problems;
  std::optional<FilmableFolder> folder =
      prepare_film(folder_ / "run", {"film.size_px=[640, 360]", "film.fps=2"}, registry(), problems);
  ASSERT_TRUE(folder);
  EXPECT_FALSE(folder->plan.knows_world);
  folder->plan.clock = film_clock(folder->plan.world.film, folder->plan.start, folder->plan.end, {}, {});
  std::vector<render::Image> frames;
  film_folder(*folder, folder_ / "run", std::make_unique<Frames>(frames), true);
  ASSERT_EQ(frames.size(), 9U);
  EXPECT_NE(frames.front().rgb, frames.back().rgb);
}

TEST(FilmedEstimators, AreSeifAndEkfUnlessTheWorldSaysOtherwise) {
  const auto names = [](const std::vector<std::string>& types, const std::vector<std::string>& wanted) {
    worlds::World world;
    for (const std::string& type : types) world.estimators.push_back(test::choice(type));
    world.film.estimators = wanted;
    return filmed_estimators(world);
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({"ekf", "seif_report", "seif"}, {}), (Names{"seif", "ekf"}));
  EXPECT_EQ(names({"seif_report", "seif"}, {}), (Names{"seif", "seif_report"}));
  EXPECT_EQ(names({"eif", "eseif", "ekf"}, {}), (Names{"ekf", "eif"}));
  EXPECT_EQ(names({"ekf", "seif", "eif"}, {"eif"}), (Names{"eif"}));
  EXPECT_EQ(names({}, {}), Names{});
}

}  // namespace
}  // namespace harness
