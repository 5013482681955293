#include "sim/render/ellipses.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>
#include <string>

namespace render {

namespace {

// [px] A thinner ellipse is drawn as if it were this wide: a line, or a dot.
constexpr double least_minor = 0.05;

const char* const ellipse_vertex_shader = R"(
layout(location = 0) in vec4 box;
layout(location = 1) in vec2 reference;
layout(location = 2) in vec3 disk_x;
layout(location = 3) in vec3 disk_y;
layout(location = 4) in vec3 disk_1;
layout(location = 5) in vec3 depth;
layout(location = 6) in vec4 edge_minor;
layout(location = 7) in vec2 lengths;
layout(location = 8) in vec4 outline_rgba;
layout(location = 9) in vec4 fill_rgba;
flat out vec2 zero;
flat out vec3 h_x, h_y, h_1;
flat out vec4 edge;
flat out vec2 sizes;
flat out vec4 outline, fill;
void main() {
  vec2 pixel = mix(box.xy, box.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
  gl_Position = clip(pixel, dot(depth, vec3(pixel - reference, 1.0)));
  zero = frame.xy + reference;
  h_x = disk_x;
  h_y = disk_y;
  h_1 = disk_1;
  edge = edge_minor;
  sizes = lengths;
  outline = outline_rgba;
  fill = fill_rgba;
}
)";

// Distances to first order: a function that is zero on the curve, divided by the length of its gradient [1/px].
const char* const ellipse_fragment_shader = R"(
flat in vec2 zero;
flat in vec3 h_x, h_y, h_1;
flat in vec4 edge;
flat in vec2 sizes;
flat in vec4 outline, fill;
out vec4 painted;

// To the unit circle, in pixels; negative inside.
float to_circle(vec3 h) {
  float r = max(length(h.xy), 1e-12 * abs(h.z) + 1e-30);
  vec2 n = h.xy / r;
  vec2 gradient = vec2(dot(n, h_x.xy) - h_x.z, dot(n, h_y.xy) - h_y.z);
  float d = (r - h.z) / max(length(gradient), 1e-12);
  // Deep inside a thin ellipse the first order points to the far ends: the near side is what counts.
  vec2 u = h.xy / h.z;
  float b = abs(dot(u, edge.zw));
  float a2 = 1.0 - (dot(u, u) - b * b);
  if (d < 0.0) d = max(d, (b - sqrt(max(a2, 0.0))) * sizes.x);
  return d;
}

// To the rays at the half angle.
float to_edges(vec3 h) {
  vec2 n = vec2(-edge.y, h.y < 0.0 ? -edge.x : edge.x);
  return dot(n, h.xy) / max(length(vec2(dot(n, h_x.xy), dot(n, h_y.xy))), 1e-12);
}

void main() {
  vec2 pixel = gl_FragCoord.xy - zero;
  vec3 h = h_x * pixel.x + h_y * pixel.y + h_1;
  if (h.z <= 0.0) discard;
  float d = to_circle(h);
  if (edge.xy != vec2(0.0)) d = max(d, to_edges(h));
  float line = outline.a * clamp(0.5 * sizes.y + 0.5 - abs(d), 0.0, min(1.0, sizes.y));
  float area = fill.a * clamp(0.5 - d, 0.0, 1.0) * (1.0 - line);
  if (line + area <= 0.0) discard;
  painted = (vec4(outline.rgb, 1.0) * line + vec4(fill.rgb, 1.0) * area) * visible();
}
)";

/// Columns for u, v and 1; rows for x w, y w and w, with x and y relative to the reference.
struct Mapping {
  Eigen::Matrix3d pixel_from_disk;
  Eigen::RowVector3d depth;  // z w
};

Mapping mapped(const Ellipse& ellipse, const Projection& projection, const Eigen::Vector4d& centre,
               const Eigen::Vector2d& reference) {
  Eigen::Matrix<double, 4, 3> all;
  for (int axis = 0; axis < 2; ++axis) {
    all.col(axis) = projection.homogeneous_direction({ellipse.axes(0, axis), ellipse.axes(1, axis), 0.0});
  }
  all.col(2) = centre;
  Mapping mapping;
  mapping.depth = all.row(2);
  mapping.pixel_from_disk.row(2) = all.row(3);
  mapping.pixel_from_disk.topRows<2>() = all.topRows<2>() - reference * all.row(3);
  return mapping;
}

/// Gives an ellipse that is thinner than least_minor this thickness, and sets its shorter axis.
void thicken(Eigen::Matrix3d& M, ScreenEllipse& screen) {
  const Eigen::Matrix2d J = M.topLeftCorner<2, 2>() / M(2, 2);  // d pixel / d (u, v) at the centre
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector2d lengths = svd.singularValues().cwiseMax(least_minor);
  if (svd.singularValues().minCoeff() < least_minor)
    M.topLeftCorner<2, 2>() = M(2, 2) * svd.matrixU() * lengths.asDiagonal() * svd.matrixV().transpose();
  screen.minor = svd.matrixV().col(1).cast<float>();
  screen.minor_length = static_cast<float>(lengths(1));
}

/// The bounds of the curve come from its dual conic M diag(1, 1, -1) M^T.
void bound(const Eigen::Matrix3d& M, const Frame& frame, ScreenEllipse& screen) {
  const Eigen::Matrix3d C = M * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * M.transpose();
  const Eigen::Vector2f size(static_cast<float>(frame.width), static_cast<float>(frame.height));
  screen.min.setZero();
  screen.max = size;
  if (!(C(2, 2) < 0.0) || !(M(2, 2) > 0.0)) return;  // a part of the ellipse is behind the camera
  const float margin = 0.5F * screen.outline_width + 1.0F;
  for (int axis = 0; axis < 2; ++axis) {
    const double middle = C(axis, 2) / C(2, 2);
    const double half = std::sqrt(std::max(0.0, middle * middle - C(axis, axis) / C(2, 2)));
    const double from = middle - half + static_cast<double>(screen.reference(axis) - margin);
    const double to = middle + half + static_cast<double>(screen.reference(axis) + margin);
    screen.min(axis) = static_cast<float>(std::clamp(from, 0.0, static_cast<double>(size(axis))));
    screen.max(axis) = static_cast<float>(std::clamp(to, 0.0, static_cast<double>(size(axis))));
  }
}

}  // namespace

std::optional<ScreenEllipse> on_screen(const Ellipse& ellipse, const Projection& projection,
                                       const Frame& frame) {
  const double outside =
      static_cast<double>(ellipse.outline_width) / projection.pixels_per_metre(ellipse.centre);
  if (!projection.sees(ellipse.centre, ellipse.axes.norm() + outside)) return std::nullopt;
  const Eigen::Vector4d centre = projection.homogeneous(ellipse.centre);
  const bool ahead = centre.w() >= projection.nearest();
  const Eigen::Vector2d reference = ahead ? Eigen::Vector2d(centre.head<2>() / centre.w())
                                          : 0.5 * Eigen::Vector2d(frame.width, frame.height);
  ScreenEllipse screen;
  // Rounded as in the shader, so that no precision is lost far off the image either.
  screen.reference = reference.cast<float>();
  auto [M, depth] = mapped(ellipse, projection, centre, screen.reference.cast<double>());
  if (ahead) thicken(M, screen);
  screen.outline_width = ellipse.outline_width;
  bound(M, frame, screen);
  if ((screen.max - screen.min).minCoeff() <= 0.0F) return std::nullopt;
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(M);
  if (!lu.isInvertible()) return std::nullopt;  // the camera is in the plane of the ellipse
  const Eigen::Matrix3d disk_from_pixel = lu.inverse();
  screen.disk_from_pixel = disk_from_pixel.cast<float>();
  screen.depth = (depth * disk_from_pixel).transpose().cast<float>();
  const double half_angle = ellipse.half_angle;
  if (half_angle < std::numbers::pi)
    screen.edge = Eigen::Vector2d(std::cos(half_angle), std::sin(half_angle)).cast<float>();
  screen.outline = Rgba(ellipse.outline);
  screen.fill = Rgba(ellipse.fill);
  return screen;
}

EllipsePainter::EllipsePainter(const Gl& gl)
    : over_(gl, "ellipses", std::string(frame_glsl) + ellipse_vertex_shader,
            std::string(everywhere_glsl) + ellipse_fragment_shader),
      behind_(gl, "ellipses behind things", std::string(frame_glsl) + ellipse_vertex_shader,
              std::string(layer_glsl) + ellipse_fragment_shader),
      array_(gl, {{4}, {2}, {3}, {3}, {3}, {3}, {4}, {2}, {Attribute::colour}, {Attribute::colour}}) {}

void EllipsePainter::paint(const std::vector<ScreenEllipse>& ellipses, const Frame& frame) {
  if (ellipses.empty()) return;
  over_.use();
  set_frame(over_, frame, Rows::upwards);
  array_.draw(ellipses);
}

void EllipsePainter::paint_behind(const Targets& layer, const std::vector<ScreenEllipse>& ellipses,
                                  const Frame& frame) {
  if (ellipses.empty()) return;
  behind_.use();
  set_frame(behind_, frame, Rows::upwards);
  layer.set_layer(behind_);
  array_.draw(ellipses);
}

}  // namespace render
