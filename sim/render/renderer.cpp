#include "sim/render/renderer.hpp"

#include "sim/render/context.hpp"
#include "sim/render/ground_pass.hpp"
#include "sim/render/marks_pass.hpp"
#include "sim/render/overlay_pass.hpp"
#include "sim/render/targets.hpp"
#include "sim/render/things_pass.hpp"

namespace render {

namespace {

std::string described(const Gl& gl) {
  const auto text = [&](GLenum name) {
    const GLubyte* const value = gl.GetString(name);
    return value == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(value));
  };
  return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

/// Whether two views differ only in what is drawn on top, as the views of two estimators do. Then one image of
/// the world can be used for both.
bool shows_the_same(const View& a, const View& b) {
  const auto is_bare = [](const Things& things) {
    const Marks& marks = things.marks;
    return things.solids.empty() && things.posts.empty() && marks.ellipses.empty() && marks.strokes.empty() &&
           marks.dots.empty();
  };
  const Camera& p = a.camera;
  const Camera& q = b.camera;
  return a.width == b.width && a.height == b.height && p.eye == q.eye && p.target == q.target &&
         p.up == q.up && p.field_of_view == q.field_of_view && p.height == q.height && is_bare(a.things) &&
         is_bare(b.things);
}

}  // namespace

class Renderer::Implementation {
 public:
  Implementation(int width, int height)
      : context_(Context::libraries()),
        gl_(context_),
        targets_(gl_, width, height),
        sunlight_(gl_),
        things_(gl_),
        ground_(gl_),
        marks_(gl_),
        overlay_(gl_),
        size_(width, height),
        description_(described(gl_)) {
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // shaders multiply by alpha
    gl_.DepthFunc(GL_LEQUAL);
    gl_.Enable(GL_PROGRAM_POINT_SIZE);
    gl_.check("getting ready");
  }

  void draw(const Scene& scene, Image& image) {
    context_.make_current();
    targets_.clear(scene.sky);
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
      const View& view = scene.views[i];
      if (i > 0 && shows_the_same(view, scene.views[i - 1])) {
        targets_.repeat(frame_of(scene.views[i - 1]), frame_of(view));
      } else {
        draw_world(scene, view);
      }
    }
    for (const View& view : scene.views) draw_on_top(scene, view);
    const Frame whole = {0, 0, size_.x(), size_.y()};
    enter(gl_, whole);
    gl_.Enable(GL_BLEND);
    gl_.Disable(GL_DEPTH_TEST);
    overlay_.draw(scene.overlay, whole);
    targets_.read(image);
    gl_.check("drawing");
  }

  const std::string& description() const { return description_; }

 private:
  Frame frame_of(const View& view) const {
    return {view.x, size_.y() - view.y - view.height, view.width, view.height};
  }

  void draw_world(const Scene& scene, const View& view) {
    if (view.width <= 0 || view.height <= 0) return;
    const Projection projection(view.camera, view.width, view.height);
    const Frame frame = frame_of(view);
    sunlight_.fit(projection, scene.shadows, scene.sky);
    things_.begin(projection, sunlight_);
    things_.add(scene.things);
    things_.add(view.things);
    if (scene.shadows) things_.draw_shadows();
    targets_.use_plain();
    enter(gl_, frame);
    ground_.draw(scene.ground, projection, frame, sunlight_, things_.shades());
    targets_.use_layer();
    things_.draw();
    targets_.compose(frame);
    for (const Things* things : {&scene.things, &view.things})
      marks_.draw_behind(targets_, things->marks, projection, frame);
  }

  void draw_on_top(const Scene& scene, const View& view) {
    if (view.width <= 0 || view.height <= 0) return;
    const Projection projection(view.camera, view.width, view.height);
    const Frame frame = frame_of(view);
    enter(gl_, frame);
    gl_.Enable(GL_BLEND);
    gl_.Disable(GL_DEPTH_TEST);
    for (const Things* things : {&scene.things, &view.things})
      marks_.draw(things->marks_on_top, projection, frame);
  }

  Context context_;
  Gl gl_;
  Targets targets_;
  Sunlight sunlight_;
  ThingsPass things_;
  GroundPass ground_;
  MarksPass marks_;
  OverlayPass overlay_;
  Eigen::Vector2i size_;  // [px]
  std::string description_;
};

Renderer::Renderer(int width, int height)
    : implementation_(std::make_unique<Implementation>(width, height)) {}

Renderer::~Renderer() = default;

void Renderer::draw(const Scene& scene, Image& image) { implementation_->draw(scene, image); }

const std::string& Renderer::description() const { return implementation_->description(); }

}  // namespace render
