#include "sim/render/marks_pass.hpp"

namespace render {

MarksPass::MarksPass(const Gl& gl) : ellipse_painter_(gl), capsule_painter_(gl) {}

void MarksPass::draw(const Marks& marks, const Projection& projection, const Frame& frame) {
  collect(marks, projection, frame);
  ellipse_painter_.paint(ellipses_, frame);
  capsule_painter_.paint(capsules_, frame, Rows::upwards);
}

void MarksPass::draw_behind(const Targets& layer, const Marks& marks, const Projection& projection,
                            const Frame& frame) {
  collect(marks, projection, frame);
  ellipse_painter_.paint_behind(layer, ellipses_, frame);
  capsule_painter_.paint_behind(layer, capsules_, frame);
}

void MarksPass::collect(const Marks& marks, const Projection& projection, const Frame& frame) {
  ellipses_.clear();
  for (const Ellipse& ellipse : marks.ellipses) {
    if (const auto screen = on_screen(ellipse, projection, frame)) ellipses_.push_back(*screen);
  }
  capsules_.clear();
  for (const Stroke& stroke : marks.strokes) append_stroke(stroke, projection, frame, capsules_);
  for (const Dot& dot : marks.dots) append_dot(dot, projection, capsules_);
}

}  // namespace render
