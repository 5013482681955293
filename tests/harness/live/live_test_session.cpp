#include "live_test_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <stdexcept>
#include <utility>

#include "harness/estimators/registry.hpp"
#include "harness/fixtures.hpp"
#include "harness/run/runnable_world.hpp"

namespace harness::test {

namespace {

constexpr PageId me = 1;

const seif::Registry& registry() {
  static const seif::Registry all = known_estimators();
  return all;
}

worlds::LoadResult load(const std::filesystem::path& world) {
  worlds::LoadResult loaded = load_runnable_world(world, {}, registry(), "");
  if (!loaded.world) throw std::runtime_error(worlds::to_string(loaded.problems.front()));
  return loaded;
}

}  // namespace

LiveTestSession::LiveTestSession(LiveSource source, bool is_paused)
    : pages_(channels_),
      session_(std::move(source), channels_,
               {is_paused, std::numeric_limits<double>::infinity(),
                [this](const SaveOrder& order, const Script& script) {
                  script.write(folder_.path(), order.t);
                  order_ = order;
                  has_saved_ = true;
                }},
               stop_) {
  pages_.opened(me);
  thread_ = std::thread([this] { session_.run(); });
}

LiveTestSession::~LiveTestSession() {
  stop_ = true;
  thread_.join();
}

int LiveTestSession::ask(nlohmann::json request) {
  request["seq"] = ++seq_;
  pages_.received(me, request.dump());
  return seq_;
}

ReceivedMessage LiveTestSession::wait_for(const std::string& kind,
                                          const std::function<bool(const nlohmann::json&)>& wanted) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(240);
  PageMessage bytes;
  while (std::chrono::steady_clock::now() < end) {
    pages_.tick();
    while (pages_.next(me, bytes)) {
      ReceivedMessage message = decoded(bytes);
      if (message.json.at("kind") == kind && (!wanted || wanted(message.json))) return message;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  throw std::runtime_error("no message of kind " + kind);
}

ReceivedMessage LiveTestSession::wait_for_state(const std::string& state) {
  return wait_for("frame", [&](const nlohmann::json& frame) { return frame.at("state") == state; });
}

std::string LiveTestSession::refusal(nlohmann::json request) {
  const int seq = ask(std::move(request));
  return wait_for("said",
                  [&](const nlohmann::json& said) {
                    return said.at("level") == "error" && (said.at("seq") == seq || said.at("seq") == 0);
                  })
      .json.at("text");
}

ReceivedMessage LiveTestSession::update(int count) {
  const std::int64_t goal = wait_for("frame").json.at("updates").get<std::int64_t>() + count;
  ask({{"do", "update"}, {"count", count}});
  return wait_for("frame", [&](const nlohmann::json& frame) {
    return frame.at("state") == "ended" || (frame.at("updates") >= goal && frame.at("state") == "paused");
  });
}

LiveTestSession::Saved LiveTestSession::save() {
  has_saved_ = false;
  ask({{"do", "save"}, {"what", "run"}});
  wait_for("said", [&](const nlohmann::json& said) {
    if (said.at("level") == "error") throw std::runtime_error(said.at("text"));
    return said.at("seq") == seq_;
  });
  while (!has_saved_) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return {order_.hash, hash_of_run(folder_ / "world.yaml"), read_file(folder_ / "world.yaml")};
}

LiveSource small_source(const TemporaryFolder& folder, std::uint64_t seed, const std::string& more) {
  write_file(folder / "small.yaml", fmt::format(R"(name: small
seed: {}
duration_s: 12
ground: {{size_m: [16, 16]}}
robot: {{start: {{x_m: -3, y_m: -3}}}}
landmarks:
  generators: [{{type: poisson_disk, count: 14, distance_m: 1.5}}]
obstacles:
  walls: [{{points_m: [[-7, -7], [7, -7], [7, 7], [-7, 7]], closed: true}}]
drive: {{mode: loop, waypoints_m: [[-3, -3], [3, -3], [3, 3], [-3, 3]]}}
sensors: {{landmark_sensor: {{rate_hz: 5, max_range_m: 6}}}}
estimators: {{seif: {{theta_x: 3, theta_max: 5}}, ekf: {{}}}}
{}
)",
                                                seed, more));
  worlds::LoadResult loaded = load(folder / "small.yaml");
  return {*loaded.world, loaded.resolved, true, {}, registry()};
}

std::string hash_of_run(const std::filesystem::path& world) {
  const worlds::LoadResult loaded = load(world);
  PreparedRun run = prepare_run(*loaded.world, registry());
  return execute_in_passing(run).summary.trajectory_hash;
}

}  // namespace harness::test
