#include "harness/report/run_figures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "harness/figures/downsampling.hpp"
#include "harness/files/csv_reader.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/score/true_names.hpp"
#include "harness/statistics/chi_square.hpp"
#include "harness/statistics/degrees.hpp"
#include "harness/statistics/ellipse.hpp"
#include "harness/stream/log_stream.hpp"
#include "worlds/geometry.hpp"

namespace harness {

namespace {

constexpr std::size_t most_bins = 1'200;       // [-] of a curve over time
constexpr std::size_t most_poses = 4'000;      // [-] of a trajectory
constexpr std::size_t most_landmarks = 4'000;  // [-] of a map
constexpr std::size_t most_ellipses = 500;     // [-] of a map

FigureCurve curve_of(const Drawn& estimator, Mark mark, Points points) {
  return {estimator.name, estimator.colour, mark, std::move(points.x), std::move(points.y)};
}

/// Leaves out a point that is not finite.
void add(double x, double y, Points& points) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  points.x.push_back(x);
  points.y.push_back(y);
}

FigureCurve trajectory(const std::filesystem::path& folder, const Drawn& which) {
  Points points;
  for (const TimedPose& pose : read_trajectory(folder, which.name))
    add(pose.T_world_robot.x, pose.T_world_robot.y, points);
  return curve_of(which, Mark::line, thinned(std::move(points), most_poses));
}

void add_ellipse(const Eigen::Vector2d& mean, const Eigen::Matrix2d& covariance, FigureCurve& curve) {
  constexpr int corners = 24;
  const Eigen::Matrix2d axes = ellipse_axes(covariance, 2.0);
  for (int i = 0; i <= corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    const Eigen::Vector2d p = mean + axes * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    curve.x.push_back(p.x());
    curve.y.push_back(p.y());
  }
  curve.x.push_back(gap);
  curve.y.push_back(gap);
}

using Ids = std::set<seif::LandmarkId>;
using TruePlaces = std::map<seif::LandmarkId, Eigen::Vector2d>;  // p_world [m]

struct TruthOfMap {
  TruePlaces places;  // of all landmarks
  Ids left_out;       // landmarks that are not drawn, for nobody
};

/// Adds what a reader is told of a landmark.
void add_tip(seif::LandmarkId landmark, const TruePlaces& places,
             const std::optional<Eigen::Matrix2d>& covariance, LandmarkTips& tips) {
  const auto truth = places.find(landmark);
  const bool is_known = truth != places.end();
  tips.id.push_back(landmark);
  tips.true_x.push_back(is_known ? truth->second.x() : gap);
  tips.true_y.push_back(is_known ? truth->second.y() : gap);
  tips.sd_x.push_back(covariance ? std::sqrt((*covariance)(0, 0)) : gap);
  tips.sd_y.push_back(covariance ? std::sqrt((*covariance)(1, 1)) : gap);
}

void add_map(const std::filesystem::path& folder, const Drawn& estimator, const TruthOfMap& truth,
             Figure& figure) {
  std::vector<MapRecord> map = read_scored_map(folder, estimator.name).landmarks;
  std::erase_if(map, [&](const MapRecord& landmark) { return truth.left_out.contains(landmark.landmark); });
  FigureCurve landmarks{estimator.name, estimator.colour, Mark::crosses};
  landmarks.landmarks.emplace();
  for (const std::size_t i : spread_sample(map.size(), most_landmarks)) {
    if (!map[i].mean.allFinite()) continue;
    landmarks.x.push_back(map[i].mean.x());
    landmarks.y.push_back(map[i].mean.y());
    add_tip(map[i].landmark, truth.places, map[i].covariance, *landmarks.landmarks);
  }
  FigureCurve ellipses{estimator.name, estimator.colour, Mark::thin_line};
  ellipses.is_silent = true;
  for (const std::size_t i : spread_sample(map.size(), most_ellipses)) {
    if (map[i].covariance) add_ellipse(map[i].mean, *map[i].covariance, ellipses);
  }
  figure.curves.push_back(std::move(landmarks));
  if (!ellipses.x.empty()) figure.curves.push_back(std::move(ellipses));
}

TruthOfMap add_true_landmarks(const std::filesystem::path& file, const Drawn& truth, Figure& figure) {
  TruthOfMap known;
  if (!std::filesystem::exists(file)) return known;
  const std::vector<TrueLandmark> landmarks = read_landmarks(file);
  for (const TrueLandmark& landmark : landmarks) {
    known.left_out.insert(landmark.landmark);
    known.places.emplace(landmark.landmark, landmark.position);
  }
  FigureCurve circles{truth.name, truth.colour, Mark::circles};
  circles.landmarks.emplace();
  for (const std::size_t i : spread_sample(landmarks.size(), most_landmarks)) {
    circles.x.push_back(landmarks[i].position.x());
    circles.y.push_back(landmarks[i].position.y());
    add_tip(landmarks[i].landmark, known.places, {}, *circles.landmarks);
    known.left_out.erase(landmarks[i].landmark);
  }
  figure.curves.push_back(std::move(circles));
  return known;
}

FigureArea area_of(const worlds::Rectangle& rectangle) {
  FigureArea area;
  const Eigen::Vector2d along = rectangle.half.x() * rectangle.axis;
  const Eigen::Vector2d across =
      rectangle.half.y() * Eigen::Vector2d(-rectangle.axis.y(), rectangle.axis.x());
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(rectangle.centre - along - across),
                                        Eigen::Vector2d(rectangle.centre + along - across),
                                        Eigen::Vector2d(rectangle.centre + along + across),
                                        Eigen::Vector2d(rectangle.centre - along + across)}) {
    area.x.push_back(corner.x());
    area.y.push_back(corner.y());
  }
  return area;
}

/// Walls, boxes, patches, and the landmarks in their true size where they are solid.
void add_solids(const worlds::World& world, Figure& figure) {
  for (const worlds::FrictionPatch& patch : world.physics.patches)
    figure.areas.push_back({false,
                            {patch.min.x(), patch.max.x(), patch.max.x(), patch.min.x()},
                            {patch.min.y(), patch.min.y(), patch.max.y(), patch.max.y()}});
  for (const worlds::Rectangle& solid : worlds::solid_rectangles(world))
    figure.areas.push_back(area_of(solid));
  if (figure.areas.size() > world.physics.patches.size()) figure.caption += " Grey: walls and boxes.";
  if (!world.physics.patches.empty()) figure.caption += " Sand: patches of other friction.";
  if (world.physics.engine == worlds::Engine::kinematic) return;
  for (const std::size_t i : spread_sample(world.landmarks.size(), most_landmarks)) {
    const worlds::Landmark& landmark = world.landmarks[i];
    figure.discs.x.push_back(landmark.position.x());
    figure.discs.y.push_back(landmark.position.y());
    figure.discs.radius.push_back(landmark.radius);
  }
  if (!world.landmarks.empty()) figure.caption += " Grey discs are landmarks in their true size.";
}

Figure map_figure(const std::filesystem::path& folder, const std::vector<Drawn>& estimators,
                  const worlds::World* world) {
  Figure figure{
      .id = "map", .title = "Trajectories and maps", .x = {"x [m]"}, .y = {"y [m]"}, .is_map = true};
  figure.caption =
      "Circles are the landmarks as they are, crosses where the estimators have them at the end, each with "
      "its "
      "2-sigma ellipse. Of large maps at most 4,000 landmarks and 500 ellipses are drawn, evenly spread.";
  if (world != nullptr) add_solids(*world, figure);
  const Drawn truth{"truth", palette::truth};
  if (std::filesystem::exists(folder / "truth.tum")) figure.curves.push_back(trajectory(folder, truth));
  const TruthOfMap known = add_true_landmarks(folder / "landmarks.csv", truth, figure);
  figure.curves.push_back(trajectory(folder, {"odometry", palette::odometry}));
  for (const Drawn& estimator : estimators) {
    figure.curves.push_back(trajectory(folder, estimator));
    add_map(folder, estimator, known, figure);
  }
  return figure;
}

/// The distance and the angle between estimate and truth.
std::array<Figure, 2> error_figures(const std::filesystem::path& folder, std::vector<Drawn> moving) {
  std::array<Figure, 2> figures = {
      Figure{.id = "position-error",
             .title = "Error of the position",
             .x = {"time [s]"},
             .y = {"error [m]", true}},
      Figure{
          .id = "heading-error", .title = "Error of the heading", .x = {"time [s]"}, .y = {"error [deg]"}}};
  figures[0].caption = "Distance from the true position after each update.";
  figures[1].caption = "Estimated less true heading after each update; odometry's is hidden at first.";
  moving.insert(moving.begin(), {"odometry", palette::odometry});
  for (const Drawn& one : moving) {
    std::array<Points, 2> points;
    for (const PosePair& pair : read_poses(folder, one.name)) {
      const Eigen::Vector3d error = pose_error(pair.est_pose, pair.true_pose);
      add(pair.t, error.head<2>().norm(), points[0]);
      add(pair.t, degrees_per_radian * error.z(), points[1]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (points[i].x.empty()) continue;
      figures.at(i).curves.push_back(
          curve_of(one, Mark::line, smallest_and_largest(std::move(points.at(i)), most_bins)));
    }
  }
  if (figures[1].curves.size() > 1)
    figures[1].curves.front().is_hidden = true;  // its error may be as large as a circle
  return figures;
}

Figure nees_figure(const std::filesystem::path& folder, const std::vector<Drawn>& estimators, int column,
                   Figure figure) {
  figure.x = {"time [s]"};
  figure.y = {"NEES [-]", true};
  for (const Drawn& estimator : estimators) {
    CsvReader rows(
        folder / (estimator.name + "_consistency.csv"),
        {{"t", "nees_pose", "nees_landmark", "landmarks_scored", "landmarks_mapped", "memory_bytes"}, {}});
    Points points;
    while (rows.next()) {
      if (!rows.is_empty(column)) add(rows.number(0), rows.number(column), points);
    }
    if (points.x.empty()) continue;
    points = smallest_and_largest(std::move(points), most_bins);
    figure.curves.push_back(curve_of(estimator, Mark::line, points));
    figure.curves.push_back(curve_of(estimator, Mark::points, std::move(points)));
  }
  return figure;
}

Figure pose_nees_figure(const std::filesystem::path& folder, const std::vector<Drawn>& estimators) {
  const ConfidenceInterval band = chi_square_band(3);
  Figure figure{.id = "nees-pose", .title = "Consistency of the pose"};
  figure.caption =
      "Normalised estimation error squared of the pose for each degree of freedom, at the scoring times: 1 "
      "is "
      "right, more is overconfident. 95 % of a right filter's values lie in the shaded band.";
  figure.bands = {{"95 %", band.low, band.high}};
  return nees_figure(folder, estimators, 1, std::move(figure));
}

Figure map_nees_figure(const std::filesystem::path& folder, const std::vector<Drawn>& estimators) {
  const ConfidenceInterval band = chi_square_band(2);
  Figure figure{.id = "nees-map", .title = "Consistency of the map"};
  figure.caption =
      "The mean over the landmarks of each one's NEES for each degree of freedom. They share the map's "
      "errors, so "
      "their mean is no calmer than the values of a single one, 95 % of which lie in the shaded band.";
  figure.bands = {{"95 % of single landmarks", band.low, band.high}};
  return nees_figure(folder, estimators, 2, std::move(figure));
}

Figure time_figure(const std::filesystem::path& folder, const std::vector<Drawn>& estimators) {
  Figure figure{
      .id = "update-time", .title = "Time for each update", .x = {"time [s]"}, .y = {"update [us]", true}};
  figure.caption =
      "Wall time of an update, from scan to scan. Where there are many, the least and the most of each "
      "stretch.";
  for (const Drawn& estimator : estimators) {
    CsvReader rows(folder / (estimator.name + "_times.csv"),
                   {{"t", "update", "motion", "measurement", "sparsification", "mean_recovery"}, {}});
    Points points;
    while (rows.next()) add(rows.number(0), rows.number(1), points);
    if (points.x.empty()) continue;
    figure.curves.push_back(
        curve_of(estimator, Mark::thin_line, smallest_and_largest(std::move(points), most_bins)));
  }
  return figure;
}

}  // namespace

std::vector<Drawn> drawn(const std::vector<std::string>& names, const std::vector<std::string>& types) {
  constexpr std::array<Rgb, 6> others = {palette::sky_blue, palette::orange, palette::purple,
                                         palette::yellow,   0x8C5A2B,        0x2F6F95};
  std::vector<Drawn> drawn;
  const auto is_free = [&](Rgb colour) {
    return std::ranges::find(drawn, colour, &Drawn::colour) == drawn.end();
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    Rgb colour = colour_of_estimator(types[i]);
    if (const auto* free = std::ranges::find_if(others, is_free); !is_free(colour) && free != others.end())
      colour = *free;
    drawn.push_back({names[i], colour});
  }
  return drawn;
}

std::vector<Figure> run_figures(const std::filesystem::path& folder, const std::vector<Drawn>& estimators,
                                const worlds::World* world) {
  std::vector<Figure> figures = {map_figure(folder, estimators, world)};
  std::ranges::move(error_figures(folder, estimators), std::back_inserter(figures));
  figures.push_back(pose_nees_figure(folder, estimators));
  figures.push_back(map_nees_figure(folder, estimators));
  figures.push_back(time_figure(folder, estimators));
  std::erase_if(figures, [](const Figure& figure) { return figure.curves.empty(); });
  return figures;
}

}  // namespace harness
