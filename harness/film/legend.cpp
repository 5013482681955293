#include "harness/film/legend.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "harness/film/fitted_text.hpp"
#include "harness/film/paint.hpp"

namespace harness {

namespace {

using Eigen::Vector2f;
using LegendItems = std::vector<render::OverlayItem>;
using Mark = LegendEntry::Mark;

constexpr float mark_width = 22.0F;  // [px]

/// An arc of an ellipse about a point, in radians from the right, clockwise on the image.
std::vector<Vector2f> arc(const Vector2f& centre, const Vector2f& radii, float from, float to) {
  constexpr int corners = 32;
  std::vector<Vector2f> points;
  for (int i = 0; i <= corners; ++i) {
    const float angle = from + (to - from) * static_cast<float>(i) / corners;
    points.push_back(centre + Vector2f(radii.x() * std::cos(angle), radii.y() * std::sin(angle)));
  }
  return points;
}

void append_rectangle(const Vector2f& centre, const Vector2f& half, const render::Colour& colour,
                      LegendItems& overlay) {
  overlay.push_back(render::Rectangle{centre - half, centre + half, colour});
}

/// A half disc, as the sensor covers one.
void append_sector(const Vector2f& centre, float scale, Rgb colour, LegendItems& overlay) {
  constexpr float pi = std::numbers::pi_v<float>;
  const Vector2f foot = centre + Vector2f(0.0F, 4.5F * scale);
  std::vector<Vector2f> edge = arc(foot, Vector2f::Constant(9.0F * scale), pi, 2.0F * pi);
  render::Band area{{}, paint(colour, 0.2F)};
  for (const Vector2f& point : edge) area.points.emplace_back(point.x(), point.y(), foot.y());
  edge.push_back(edge.front());
  overlay.push_back(std::move(area));
  overlay.push_back(render::Polyline{std::move(edge), scale, paint(colour, 0.8F)});
}

/// `middle` is the middle of the mark.
void append_mark(const LegendEntry& entry, const Vector2f& middle, float scale, LegendItems& overlay) {
  const Vector2f half(0.5F * mark_width * scale, 0.0F);
  const render::Colour colour = paint(entry.colour);
  switch (entry.mark) {
    case Mark::line:
      overlay.push_back(render::Polyline{{middle - half, middle + half}, entry.size * scale, colour});
      return;
    case Mark::dashes:
      append_dashes({middle - half, middle + half}, chart_dashes(scale, entry.colour), overlay);
      return;
    case Mark::band:
      append_rectangle(middle, {half.x(), 4.5F * scale}, paint(entry.colour, band_alpha), overlay);
      return;
    case Mark::disk:
      overlay.push_back(render::Polyline{{middle, middle}, 2.0F * entry.size * scale, colour});
      return;
    case Mark::ring:
      overlay.push_back(
          render::Polyline{arc(middle, {9.0F * scale, 5.0F * scale}, 0.0F, 2.0F * std::numbers::pi_v<float>),
                           1.4F * scale, colour});
      return;
    case Mark::sector:
      append_sector(middle, scale, entry.colour, overlay);
      return;
    case Mark::post:
      append_rectangle(middle, {2.0F * scale, 6.0F * scale}, colour, overlay);
      return;
    case Mark::box:
      append_rectangle(middle, {half.x(), 5.0F * scale}, paint(paints::faint_ink), overlay);
      append_rectangle(middle, {half.x() - scale, 4.0F * scale}, colour, overlay);
      return;
  }
}

}  // namespace

LegendFacts legend_facts(const worlds::World& world, bool knows_world, const LogDescription& log) {
  LegendFacts facts;
  facts.has_truth = log.true_start.has_value();
  facts.has_true_landmarks = log.landmarks && !log.landmarks->empty();
  facts.knows_world = knows_world;
  facts.has_obstacles = knows_world && (!world.walls.empty() || !world.boxes.empty());
  facts.has_patches = knows_world && !world.physics.patches.empty();
  facts.has_hidden = knows_world && world.physics.engine != worlds::Engine::kinematic;
  facts.has_false_detections = !knows_world || world.landmark_sensor.false_detections > 0.0;
  return facts;
}

std::vector<LegendEntry> legend_entries(const worlds::FilmLayers& layers, const LegendFacts& facts,
                                        const std::vector<Shown>& shown) {
  std::vector<LegendEntry> entries;
  const auto add = [&](bool is_drawn, const LegendEntry& entry) {
    if (is_drawn) entries.push_back(entry);
  };
  const bool believes = !shown.empty();
  const Rgb first = believes ? shown.front().colour : palette::truth;
  const bool has_links = std::ranges::any_of(shown, &Shown::has_links);
  add(layers.truth && facts.has_truth, {Mark::line, palette::truth, 2.0F, "true path"});
  add(layers.odometry, {Mark::line, palette::odometry, 2.0F, "odometry alone"});
  for (const Shown& each : shown)
    add(layers.estimate, {Mark::line, each.colour, 2.4F, "path of " + each.name});
  add(layers.ellipses && believes, {Mark::ring, first, 0.0F, "2σ: where it may be"});
  for (const Shown& each : shown)
    add(layers.pose_error,
        {&each == &shown.front() ? Mark::band : Mark::dashes, each.colour, 0.0F, "3σ of " + each.name});
  add(layers.errors && believes && (facts.has_truth || facts.has_true_landmarks),
      {Mark::line, palette::purple, 2.0F, "error"});
  add(facts.has_true_landmarks, {Mark::post, paints::post, 0.0F, "landmark, true"});
  add(layers.landmarks && believes, {Mark::disk, first, 2.8F, "landmark, estimated"});
  add(layers.active && has_links, {Mark::disk, palette::orange, 5.0F, "active: tied to robot"});
  add(layers.links && has_links, {Mark::line, paints::faint_ink, 1.2F, "link of information"});
  add(layers.range && facts.knows_world, {Mark::sector, palette::sky_blue, 0.0F, "range of the sensor"});
  add(layers.rays, {Mark::line, palette::sky_blue, 2.0F, "seen"});
  add(layers.rays && facts.has_hidden, {Mark::line, paints::hidden_ray, 2.0F, "hidden"});
  add(layers.rays && facts.has_false_detections, {Mark::disk, palette::purple, 3.0F, "false detection"});
  add(facts.has_obstacles, {Mark::box, paints::wall, 0.0F, "wall or box"});
  add(facts.has_patches, {Mark::box, paints::ice, 0.0F, "other friction"});
  return entries;
}

void append_legend(const Frame& frame, float scale, const std::vector<LegendEntry>& entries,
                   LegendItems& overlay) {
  constexpr std::size_t fewest_rows = 6;
  const std::size_t rows = std::max(fewest_rows, (entries.size() + 1) / 2);
  const float pitch = (frame.height - 16.0F * scale) / static_cast<float>(rows);
  const float size = std::min(12.5F * scale, 0.84F * pitch);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Vector2f left(frame.x + 14.0F * scale + static_cast<float>(i / rows) * 0.5F * frame.width,
                        frame.y + 8.0F * scale + (static_cast<float>(i % rows) + 0.5F) * pitch);
    append_mark(entries[i], left + Vector2f(0.5F * mark_width * scale, 0.0F), scale, overlay);
    overlay.push_back(render::Text{
        left + Vector2f(30.0F * scale, 0.36F * size), size, render::Align::left, render::Weight::regular,
        paint(paints::ink),
        fitted(entries[i].words, size, render::Weight::regular, 0.5F * frame.width - 48.0F * scale)});
  }
}

}  // namespace harness
