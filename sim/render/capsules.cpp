#include "sim/render/capsules.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace render {

namespace {

const char* const capsule_vertex_shader = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in float width;
layout(location = 3) in vec4 cuts;
layout(location = 4) in vec4 rgba;
flat out vec4 ends;
flat out vec4 bisectors;
flat out float radius;
flat out vec4 colour;
void main() {
  vec2 along = to.xy - from.xy;
  float reach = length(along);
  along = reach > 1e-4 ? along / reach : vec2(1.0, 0.0);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec3 end = corner.x > 0.5 ? to : from;
  vec2 across = vec2(-along.y, along.x);
  vec2 pixel = end.xy + (0.5 * width + 1.0) * ((2.0 * corner.x - 1.0) * along + (2.0 * corner.y - 1.0) * across);
  gl_Position = clip(pixel, end.z);
  ends = vec4(from.xy, to.xy);
  bisectors = cuts;
  radius = 0.5 * width;
  colour = rgba;
}
)";

const char* const capsule_fragment_shader = R"(
flat in vec4 ends;
flat in vec4 bisectors;
flat in float radius;
flat in vec4 colour;
out vec4 painted;
void main() {
  vec2 from_a = pixel() - ends.xy;
  vec2 from_b = pixel() - ends.zw;
  if (dot(from_a, bisectors.xy) < 0.0) discard;
  if (bisectors.zw != vec2(0.0) && dot(from_b, bisectors.zw) >= 0.0) discard;
  vec2 along = ends.zw - ends.xy;
  float t = clamp(dot(from_a, along) / max(dot(along, along), 1e-8), 0.0, 1.0);
  float cover = clamp(radius + 0.5 - length(from_a - t * along), 0.0, min(1.0, 2.0 * radius));
  if (cover <= 0.0) discard;
  painted = vec4(colour.rgb, 1.0) * (colour.a * cover * visible());
}
)";

/// Keeps the part of [a, b] where inside(p) = da + t (db - da) >= 0.
bool cut(double da, double db, double& from, double& to) {
  if (da < 0.0 && db < 0.0) return false;
  if (da < 0.0) from = std::max(from, da / (da - db));
  if (db < 0.0) to = std::min(to, da / (da - db));
  return from < to;
}

struct Ends {
  Eigen::Vector4d a;
  Eigen::Vector4d b;
};

/// The part of the line from a to b that may be visible: in front of the camera, and on the image or at most
/// `margin` outside it.
std::optional<Ends> clipped(const Ends& line, const Projection& projection, const Frame& frame,
                            double margin) {
  double from = 0.0;
  double to = 1.0;
  const auto keep = [&](auto&& inside) { return cut(inside(line.a), inside(line.b), from, to); };
  using Point = Eigen::Vector4d;
  const bool seen = keep([&](const Point& p) { return p.w() - projection.nearest(); }) &&
                    keep([&](const Point& p) { return p.x() + margin * p.w(); }) &&
                    keep([&](const Point& p) { return (frame.width + margin) * p.w() - p.x(); }) &&
                    keep([&](const Point& p) { return p.y() + margin * p.w(); }) &&
                    keep([&](const Point& p) { return (frame.height + margin) * p.w() - p.y(); });
  if (!seen) return std::nullopt;
  return Ends{line.a + from * (line.b - line.a), line.a + to * (line.b - line.a)};
}

Eigen::Vector3f on_image(const Eigen::Vector4d& p) { return (p.head<3>() / p.w()).cast<float>(); }

}  // namespace

CapsulePainter::CapsulePainter(const Gl& gl)
    : over_(gl, "capsules", std::string(frame_glsl) + capsule_vertex_shader,
            std::string(pixel_glsl) + everywhere_glsl + capsule_fragment_shader),
      behind_(gl, "capsules behind things", std::string(frame_glsl) + capsule_vertex_shader,
              std::string(pixel_glsl) + layer_glsl + capsule_fragment_shader),
      array_(gl, {{3}, {3}, {1}, {4}, {Attribute::colour}}) {}

void CapsulePainter::paint(const std::vector<Capsule>& capsules, const Frame& frame, Rows rows) {
  if (capsules.empty()) return;
  over_.use();
  set_frame(over_, frame, rows);
  array_.draw(capsules);
}

void CapsulePainter::paint_behind(const Targets& layer, const std::vector<Capsule>& capsules,
                                  const Frame& frame) {
  if (capsules.empty()) return;
  behind_.use();
  set_frame(behind_, frame, Rows::upwards);
  layer.set_layer(behind_);
  array_.draw(capsules);
}

void append_stroke(const Stroke& stroke, const Projection& projection, const Frame& frame,
                   std::vector<Capsule>& capsules) {
  const Ends line = {projection.homogeneous(stroke.from), projection.homogeneous(stroke.to)};
  const auto seen = clipped(line, projection, frame, stroke.width + 2.0);
  if (!seen) return;
  Capsule capsule;
  capsule.a = on_image(seen->a);
  capsule.b = on_image(seen->b);
  capsule.width = stroke.width;
  capsule.colour = Rgba(stroke.colour);
  capsules.push_back(capsule);
}

void append_dot(const Dot& dot, const Projection& projection, std::vector<Capsule>& capsules) {
  const Eigen::Vector4d p = projection.homogeneous(dot.centre);
  if (p.w() < projection.nearest()) return;
  Capsule capsule;
  capsule.a = capsule.b = on_image(p);
  capsule.width = 2.0F * dot.radius;
  capsule.colour = Rgba(dot.colour);
  capsules.push_back(capsule);
}

void append_polyline(const Polyline& line, std::vector<Capsule>& capsules) {
  constexpr float smallest_step = 0.25F;  // [px] shorter steps would paint joints over joints
  Capsule capsule;
  capsule.width = line.width;
  capsule.colour = Rgba(line.colour);
  const std::size_t first = capsules.size();
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Eigen::Vector2f& p = line.points[i];
    capsule.b.head<2>() = p;
    if (i > 0 && (p - capsule.a.head<2>()).norm() < smallest_step) continue;
    if (i > 0) capsules.push_back(capsule);
    capsule.a = capsule.b;
  }
  if (capsules.size() == first && !line.points.empty()) capsules.push_back(capsule);
  for (std::size_t i = first; i + 1 < capsules.size(); ++i) {
    const auto along = [&](std::size_t j) {
      return Eigen::Vector2f((capsules[j].b - capsules[j].a).head<2>().normalized());
    };
    capsules[i].cut_b = capsules[i + 1].cut_a = along(i) + along(i + 1);
  }
}

}  // namespace render
