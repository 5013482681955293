#include "sim/render/overlay_pass.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/render/renderer.hpp"

namespace render {

namespace {

const char* const box_vertex_shader = R"(
layout(location = 0) in vec4 box;
layout(location = 1) in vec4 source;
layout(location = 2) in vec4 rgba;
flat out vec4 bounds;
flat out vec4 colour;
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 here = mix(box.xy - 1.0, box.zw + 1.0, corner);  // room for soft edges
  at = mix(source.xy, source.zw, (here - box.xy) / max(box.zw - box.xy, 1e-6));
  gl_Position = clip(here, 0.0);
  bounds = box;
  colour = rgba;
}
)";

const char* const box_fragment_glsl = R"(
flat in vec4 bounds;
flat in vec4 colour;
in vec2 at;
out vec4 painted;
// How much of the pixel lies inside.
float cover() {
  vec2 here = pixel();
  vec2 inside = min(here + 0.5, bounds.zw) - max(here - 0.5, bounds.xy);
  return max(inside.x, 0.0) * max(inside.y, 0.0);
}
)";

const char* const patch_fragment_shader = R"(
uniform sampler2D atlas;
void main() {
  float ink = texelFetch(atlas, ivec2(max(floor(at), 0.0)), 0).r;
  painted = vec4(colour.rgb, 1.0) * (colour.a * ink * cover());
}
)";

const char* const raster_fragment_shader = R"(
uniform sampler2D cells;
void main() {
  ivec2 size = textureSize(cells, 0);
  vec4 cell = texelFetch(cells, clamp(ivec2(floor(at)), ivec2(0), size - 1), 0);
  painted = vec4(cell.rgb, 1.0) * (cell.a * colour.a * cover());
}
)";

const char* const slice_vertex_shader = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 rgba;
flat out vec3 left;
flat out vec3 slopes;  // of the two lines; and the last x
flat out vec4 colour;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  float low = min(min(from.y, from.z), min(to.y, to.z)) - 1.0;
  float high = max(max(from.y, from.z), max(to.y, to.z)) + 1.0;
  gl_Position = clip(vec2(mix(from.x, to.x, corner.x), mix(low, high, corner.y)), 0.0);
  left = from;
  slopes = vec3((to.yz - from.yz) / max(to.x - from.x, 1e-6), to.x);
  colour = rgba;
}
)";

// A pixel belongs to the slice that contains its centre, so there is no seam between slices.
const char* const slice_fragment_shader = R"(
flat in vec3 left;
flat in vec3 slopes;
flat in vec4 colour;
out vec4 painted;
void main() {
  vec2 here = pixel();
  if (here.x < left.x || here.x >= slopes.z) discard;
  vec2 lines = left.yz + slopes.xy * (here.x - left.x);
  vec2 away = (here.y - lines) / sqrt(1.0 + slopes.xy * slopes.xy);
  vec2 below = clamp(0.5 + away, 0.0, 1.0);
  painted = vec4(colour.rgb, 1.0) * (colour.a * abs(below.x - below.y));
}
)";

Program box_program(const Gl& gl, const char* name, const char* fragment_shader) {
  return Program(gl, name, std::string(frame_glsl) + box_vertex_shader,
                 std::string(pixel_glsl) + box_fragment_glsl + fragment_shader);
}

}  // namespace

OverlayPass::OverlayPass(const Gl& gl)
    : gl_(gl),
      patch_(box_program(gl, "text", patch_fragment_shader)),
      slice_(gl, "bands", std::string(frame_glsl) + slice_vertex_shader,
             std::string(pixel_glsl) + slice_fragment_shader),
      raster_(box_program(gl, "rasters", raster_fragment_shader)),
      patch_vertices_(gl, {{4}, {4}, {Attribute::colour}}),
      slice_vertices_(gl, {{3}, {3}, {Attribute::colour}}),
      raster_vertices_(gl, {{4}, {4}, {Attribute::colour}}),
      capsule_painter_(gl),
      atlas_(gl) {
  gl_.GenTextures(1, &raster_texture_);
  gl_.BindTexture(GL_TEXTURE_2D, raster_texture_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void OverlayPass::draw(const std::vector<OverlayItem>& items, const Frame& frame) {
  frame_ = frame;
  for (const OverlayItem& item : items) {
    std::visit([this](const auto& each) { add(each); }, item);
  }
  flush();
}

void OverlayPass::add(const Rectangle& rectangle) {
  if (patches_.empty()) flush();
  Patch patch;
  patch.box << rectangle.min, rectangle.max;
  patch.atlas.setConstant(0.5F);
  patch.colour = Rgba(rectangle.colour);
  patches_.push_back(patch);
}

void OverlayPass::add(const Text& text) {
  if (patches_.empty()) flush();
  const float share = text.align == Align::left ? 0.0F : text.align == Align::centre ? 0.5F : 1.0F;
  float pen = text.position.x() - share * text_width(text.text, text.size, text.weight);
  const float baseline = std::round(text.position.y());
  Patch patch;
  patch.colour = Rgba(text.colour);
  for (const char32_t character : decoded(text.text)) {
    const float steps = std::round(pen * GlyphAtlas::phases);
    const float column = std::floor(steps / GlyphAtlas::phases);
    const int phase = static_cast<int>(steps - column * GlyphAtlas::phases);
    const AtlasGlyph& glyph = atlas_.glyph(character, text.weight, text.size, phase);
    const Eigen::Vector2f size = Eigen::Vector2i(glyph.width, glyph.height).cast<float>();
    const Eigen::Vector2f source = Eigen::Vector2i(glyph.x, glyph.y).cast<float>();
    const Eigen::Vector2f corner(column + static_cast<float>(glyph.left),
                                 baseline - static_cast<float>(glyph.top));
    patch.box << corner, corner + size;
    patch.atlas << source, source + size;
    if (glyph.width > 0) patches_.push_back(patch);
    pen += text.size * advance(character, text.weight);
  }
}

void OverlayPass::add(const Polyline& line) {
  if (capsules_.empty()) flush();
  append_polyline(line, capsules_);
}

void OverlayPass::add(const Band& band) {
  if (slices_.empty()) flush();
  for (std::size_t i = 1; i < band.points.size(); ++i) {
    const bool forwards = band.points[i - 1].x() <= band.points[i].x();
    const std::size_t from = forwards ? i - 1 : i;
    slices_.push_back({band.points[from], band.points[2 * i - 1 - from], Rgba(band.colour)});
  }
}

void OverlayPass::add(const Raster& raster) {
  flush();
  if (raster.columns <= 0 || raster.rows <= 0) return;
  if (raster.rgba.size() !=
      4 * static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows))
    throw std::invalid_argument("a raster does not have as many cells as it says");
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, raster_texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, raster.columns, raster.rows, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 raster.rgba.data());
  raster_.use();
  set_frame(raster_, frame_, Rows::downwards);
  raster_.set("cells", 0);
  Patch patch;
  patch.box << raster.min, raster.max;
  patch.atlas << 0.0F, 0.0F, static_cast<float>(raster.columns), static_cast<float>(raster.rows);
  patch.colour = Rgba(Colour{1.0F, 1.0F, 1.0F});
  raster_vertices_.draw(std::vector<Patch>{patch});
}

void OverlayPass::flush() {
  paint_patches();
  paint_slices();
  capsule_painter_.paint(capsules_, frame_, Rows::downwards);
  capsules_.clear();
}

void OverlayPass::paint_patches() {
  if (patches_.empty()) return;
  patch_.use();
  set_frame(patch_, frame_, Rows::downwards);
  atlas_.bind();
  patch_.set("atlas", 0);
  patch_vertices_.draw(patches_);
  patches_.clear();
}

void OverlayPass::paint_slices() {
  if (slices_.empty()) return;
  slice_.use();
  set_frame(slice_, frame_, Rows::downwards);
  slice_vertices_.draw(slices_);
  slices_.clear();
}

}  // namespace render
