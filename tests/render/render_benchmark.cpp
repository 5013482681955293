// Measures the time of a frame of 1280 x 720 pixels.

#include <benchmark/benchmark.h>

#include <cmath>

#include "scenes.hpp"
#include "sim/render/renderer.hpp"

namespace render {
namespace {

void draw(benchmark::State& state, const Scene& scene) {
  Renderer renderer(1280, 720);
  Image image;
  renderer.draw(scene, image);  // the shaders are compiled now
  for (auto _ : state) renderer.draw(scene, image);
  state.SetLabel(renderer.description());
}

void film_frame(benchmark::State& state) { draw(state, test::yard(300, 300)); }
BENCHMARK(film_frame)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void without_shadows(benchmark::State& state) {
  Scene scene = test::yard(300, 300);
  scene.shadows = false;
  draw(state, scene);
}
BENCHMARK(without_shadows)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// All posts of a field of 2 km in one view.
void many_posts(benchmark::State& state) {
  Camera camera;
  camera.eye = {0.0, -1500.0, 900.0};
  Scene scene = test::bare(1280, 720, camera);
  scene.ground.size = {2000.0, 2000.0};
  scene.ground.grid = 50.0;
  const auto side = static_cast<int>(std::sqrt(state.range(0)));
  for (int i = 0; i < side * side; ++i) {
    Post post;
    post.position = {2000.0 * (i % side) / side - 1000.0, 2000.0 * (i / side) / side - 1000.0};
    post.radius = 0.3F;
    post.height = 1.5F;
    scene.things.posts.push_back(post);
  }
  draw(state, scene);
}
BENCHMARK(many_posts)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace render

BENCHMARK_MAIN();
