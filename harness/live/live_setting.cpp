#include "harness/live/live_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <variant>

#include "harness/estimators/plugins.hpp"
#include "harness/film/paint.hpp"
#include "harness/film/stage.hpp"
#include "harness/terminal/version.hpp"
#include "worlds/film_layers.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

std::string css(Rgb colour) { return fmt::format("#{:06x}", colour); }

Rgb rgb_of(const render::Colour& colour) {
  const auto channel = [](float value) {
    return static_cast<Rgb>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
  };
  return channel(colour.r) << 16U | channel(colour.g) << 8U | channel(colour.b);
}

Json json_of(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

Json json_of(const Eigen::Isometry3d& T) {
  const Eigen::Matrix4d matrix = T.matrix();
  return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
}

/// The world with what has appeared in it by now.
worlds::World world_at(const worlds::World& world, double t) {
  worlds::World now = world;
  for (const worlds::Fault& fault : world.faults) {
    if (fault.at > t) continue;
    if (fault.kind == worlds::FaultKind::ice) now.physics.patches.push_back(fault.patch);
    if (fault.kind == worlds::FaultKind::wall) now.walls.push_back(fault.wall);
  }
  return now;
}

std::size_t landmarks_at(const worlds::World& world, double t) {
  return world.landmarks.size() +
         static_cast<std::size_t>(std::ranges::count_if(world.faults, [t](const auto& fault) {
           return fault.kind == worlds::FaultKind::landmark && fault.at <= t;
         }));
}

/// The parts of the robot in its own frame. The wheels stand where the robot's frame has its y axis on the left and
/// on the right; the parts of a wheel follow each other.
Json robot_json(const Stage& stage, const worlds::Robot& robot) {
  render::Things things;
  stage.append_robot({}, 1.0, things);
  Json parts = Json::array();
  for (const render::Solid& solid : things.solids) {
    const Eigen::Vector3d p = solid.T_world_solid.translation();
    const bool is_wheel = std::abs(std::abs(p.y()) - 0.5 * robot.track) < 1e-9 && std::abs(p.x()) < 1e-9;
    parts.push_back({{"shape", solid.shape == render::Shape::box ? "box" : "cylinder"},
                     {"T", json_of(solid.T_world_solid)},
                     {"size", {solid.size.x(), solid.size.y(), solid.size.z()}},
                     {"colour", css(rgb_of(solid.colour))},
                     {"wheel", !is_wheel ? Json(nullptr) : Json(p.y() > 0.0 ? "left" : "right")}});
  }
  return parts;
}

Json option_json_of(const seif::OptionSpec& spec, const seif::OptionValue& value) {
  const auto limit = [](double bound) { return std::isfinite(bound) ? Json(bound) : Json(nullptr); };
  return {{"key", spec.key},
          {"help", spec.help},
          {"value", std::visit([](const auto& v) { return Json(v); }, value)},
          {"min", limit(spec.min)},
          {"max", limit(spec.max)},
          {"whole", std::holds_alternative<std::int64_t>(spec.fallback)},
          {"changeable", spec.changeable},
          {"choices", spec.choices.empty() ? Json(nullptr) : Json(spec.choices)}};
}

std::string_view name_of_matrix(seif::BeliefMatrix matrix) {
  if (matrix == seif::BeliefMatrix::none) return "none";
  return matrix == seif::BeliefMatrix::information ? "information" : "covariance";
}

Json estimator_json(const LiveSubject& subject, const LiveEstimator& estimator) {
  Json json = {{"name", estimator.name},
               {"matrix", name_of_matrix(estimator.filter->belief_matrix())},
               {"odometry_sd_factor", estimator.odometry_sd_factor},
               {"observation_sd_factor", estimator.observation_sd_factor},
               {"options", Json::array()}};
  const std::vector<worlds::EstimatorChoice>& choices = subject.world.estimators;
  const auto choice = std::ranges::find(choices, estimator.name, &worlds::EstimatorChoice::name);
  const std::string type = choice == choices.end() ? estimator.name : choice->type;
  json["type"] = type;
  if (choice == choices.end()) return json;
  for (const seif::OptionSpec& spec : type_of(subject.registry, *choice).options) {
    const auto value = choice->options.find(spec.key);
    json["options"].push_back(
        option_json_of(spec, value == choice->options.end() ? spec.fallback : value->second));
  }
  return json;
}

/// An estimator has the colour of its type, and a further one of that type a colour that is still free.
void give_colours(Json& estimators) {
  std::vector<std::string> taken;
  for (Json& estimator : estimators) {
    std::string colour = css(colour_of_estimator(estimator.at("type").get<std::string>()));
    for (const Rgb other : {palette::sky_blue, palette::purple, palette::vermilion, palette::yellow,
                            palette::blue, palette::green}) {
      if (std::ranges::find(taken, colour) == taken.end()) break;
      colour = css(other);
    }
    estimator["colour"] = colour;
    taken.push_back(colour);
  }
}

Json colours_json() {
  const render::Scene scene;
  return {{"sky", css(rgb_of(scene.sky))},
          {"ground", css(rgb_of(scene.ground.colour))},
          {"grid", css(rgb_of(scene.ground.lines))},
          {"post", css(paints::post)},
          {"truth", css(palette::truth)},
          {"odometry", css(palette::odometry)},
          {"orange", css(palette::orange)},
          {"purple", css(palette::purple)},
          {"sky_blue", css(palette::sky_blue)},
          {"hidden_ray", css(paints::hidden_ray)},
          {"link", css(paints::faint_ink)}};
}

Json sensor_json(const LiveSubject& subject) {
  const seif::Pose2& mount = subject.log.T_robot_sensor;
  return {{"range_m", subject.log.max_range ? Json(*subject.log.max_range) : Json(nullptr)},
          {"fov_rad", subject.knows_world ? subject.world.landmark_sensor.fov : 2.0 * std::numbers::pi},
          {"mount", {mount.x, mount.y, mount.theta}}};
}

Json layers_json(const worlds::FilmLayers& layers) {
  Json json = Json::object();
  for (const worlds::FilmLayer& layer : worlds::film_layers)
    json[std::string(layer.name)] = layers.*layer.shown;
  return json;
}

std::string hello_json(const LiveSubject& subject, const Stage& stage, std::uint64_t epoch) {
  const worlds::World& world = subject.world;
  const LiveAbilities& can = subject.abilities;
  Json json = {{"kind", "hello"},
               {"epoch", epoch},
               {"program", fmt::format("seifbed {}", program_version())},
               {"name", subject.log.name},
               {"description", subject.knows_world ? world.description : ""},
               {"seed", world.seed},
               {"source", can.world ? "world" : "log"},
               {"start_t", subject.log.start_t},
               {"duration_s", can.world ? Json(world.duration) : Json(nullptr)},
               {"step_s", can.world ? Json(1.0 / world.physics.step_rate) : Json(nullptr)},
               {"ground", json_of(stage.ground(true).size)},
               {"colours", colours_json()},
               {"view", {{"min", json_of(stage.subject().min)}, {"max", json_of(stage.subject().max)}}},
               {"sensor", sensor_json(subject)},
               {"robot", robot_json(stage, world.robot)},
               {"estimators", Json::array()},
               {"layers", layers_json(world.film.layers)},
               {"can",
                {{"drive", can.world},
                 {"kidnap", can.world},
                 {"sensors", can.world},
                 {"world", can.world},
                 {"control", can.control},
                 {"options", can.control},
                 {"beside", can.control},
                 {"back", can.control},
                 {"save", can.control && can.world}}},
               {"why_not", can.why_not}};
  for (const LiveEstimator& estimator : subject.believers.estimators)
    json["estimators"].push_back(estimator_json(subject, estimator));
  give_colours(json["estimators"]);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

LiveSetting live_setting(const LiveSubject& subject, double t, std::uint64_t epoch, std::uint64_t version) {
  const Stage stage(world_at(subject.world, t), subject.knows_world, subject.log, {});
  LiveSetting setting{epoch, version, hello_json(subject, stage, epoch), {}, {}, {}, {}, {}};
  for (const render::Solid& solid : stage.solids()) {
    const Eigen::Matrix4f T = solid.T_world_solid.matrix().cast<float>();
    setting.solids.insert(setting.solids.end(), T.data(), T.data() + T.size());
    for (const double side : solid.size) setting.solids.push_back(static_cast<float>(side));
    setting.tints.push_back(rgb_of(solid.colour));
  }
  for (const LiveEstimator& estimator : subject.believers.estimators)
    setting.estimators.push_back(estimator.name);
  if (!subject.log.landmarks) return setting;
  std::size_t count = subject.log.landmarks->size();
  if (subject.abilities.world) count = std::min(count, landmarks_at(subject.world, t));
  for (std::size_t i = 0; i < count; ++i) {
    const TrueLandmark& landmark = (*subject.log.landmarks)[i];
    setting.post_ids.push_back(static_cast<std::uint32_t>(landmark.landmark));
    setting.posts.insert(setting.posts.end(), {static_cast<float>(landmark.position.x()),
                                               static_cast<float>(landmark.position.y()),
                                               static_cast<float>(std::max(landmark.radius, 0.03))});
  }
  return setting;
}

}  // namespace harness
