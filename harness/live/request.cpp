#include "harness/live/request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "harness/files/bad_input.hpp"

namespace harness {

namespace {

using RequestJson = nlohmann::json;

constexpr double largest = 1e6;           // in any unit
constexpr std::size_t longest_name = 64;  // [byte]
constexpr std::size_t most_points = 64;   // [-] of a wall

/// The fields of a request, each checked as it is read.
class RequestFields {
 public:
  explicit RequestFields(const RequestJson& json) : json_(json) {}

  double number(const char* key) const { return number_of(at(key), key); }

  bool flag(const char* key) const {
    if (!at(key).is_boolean()) refuse(key, "true or false");
    return at(key).get<bool>();
  }

  std::string text(const char* key) const {
    if (!at(key).is_string() || at(key).get_ref<const std::string&>().size() > longest_name)
      refuse(key, "a short text");
    return at(key).get<std::string>();
  }

  Eigen::Vector2d point(const char* key) const { return point_of(at(key), key); }

  std::vector<Eigen::Vector2d> points(const char* key) const {
    const RequestJson& list = at(key);
    if (!list.is_array() || list.size() < 2 || list.size() > most_points) refuse(key, "a list of points");
    std::vector<Eigen::Vector2d> points;
    for (const RequestJson& item : list) points.push_back(point_of(item, key));
    return points;
  }

  std::int64_t whole(const char* key) const {
    const double value = number(key);
    if (value != std::round(value)) refuse(key, "a whole number");
    return static_cast<std::int64_t>(value);
  }

  bool has(const char* key) const { return json_.contains(key); }
  const RequestJson& at(const char* key) const {
    if (!json_.contains(key)) throw BadInput(fmt::format("'{}' is missing", key));
    return json_.at(key);
  }

  [[noreturn]] static void refuse(const char* key, const char* wanted) {
    throw BadInput(fmt::format("'{}' must be {}", key, wanted));
  }

 private:
  static double number_of(const RequestJson& value, const char* key) {
    if (!value.is_number() || !(std::abs(value.get<double>()) <= largest))
      refuse(key, "a number of at most 1e6");
    return value.get<double>();
  }

  static Eigen::Vector2d point_of(const RequestJson& value, const char* key) {
    if (!value.is_array() || value.size() != 2) refuse(key, "a point [x, y]");
    return {number_of(value[0], key), number_of(value[1], key)};
  }

  const RequestJson& json_;
};

/// How many times; once if it does not say.
std::int64_t count_of(const RequestFields& fields) {
  if (!fields.has("count")) return 1;
  const std::int64_t count = fields.whole("count");
  if (count < 1) RequestFields::refuse("count", "at least 1");
  return count;
}

Ask speed_of(const RequestFields& fields) {
  if (fields.at("value") == "max") return asks::Speed{std::numeric_limits<double>::infinity()};
  const double factor = fields.number("value");
  if (factor < 0.01 || factor > 10'000.0) RequestFields::refuse("value", "from 0.01 to 10000, or \"max\"");
  return asks::Speed{factor};
}

Ask silence_of(const RequestFields& fields) {
  const std::string sensor = fields.text("sensor");
  if (sensor != "landmark_sensor" && sensor != "encoders")
    RequestFields::refuse("sensor", "landmark_sensor or encoders");
  return asks::Silence{
      sensor == "encoders" ? worlds::FaultySensor::encoders : worlds::FaultySensor::landmark_sensor,
      fields.flag("on")};
}

Ask option_of(const RequestFields& fields) {
  return asks::Option{fields.text("estimator"), fields.text("option"), fields.number("value")};
}

Ask beside_of(const RequestFields& fields) {
  seif::OptionValue value;
  if (fields.at("value").is_boolean()) {
    value = fields.flag("value");
  } else if (fields.at("value").is_string()) {
    value = fields.text("value");
  } else {
    value = fields.number("value");
  }
  return asks::Beside{fields.text("estimator"), fields.text("option"), value};
}

Ask save_of(const RequestFields& fields) {
  const std::string what = fields.text("what");
  if (what != "run" && what != "film" && what != "report")
    RequestFields::refuse("what", "run, film or report");
  return asks::Save{what};
}

Ask inspect_of(const RequestFields& fields) {
  return asks::Inspect{fields.text("estimator"), static_cast<seif::LandmarkId>(fields.whole("id"))};
}

Ask view_of(const RequestFields& fields) {
  return asks::View{fields.point("min"), fields.point("max"), fields.has("matrix") && fields.flag("matrix"),
                    !fields.has("links") || fields.flag("links")};
}

using Reader = std::function<Ask(const RequestFields&)>;

template <class Empty>
Reader always() {
  return [](const RequestFields&) { return Ask(Empty{}); };
}

const std::map<std::string, Reader, std::less<>>& readers() {
  using Fields = const RequestFields&;
  static const std::map<std::string, Reader, std::less<>> all = {
      {"pause", always<asks::Pause>()},
      {"go", always<asks::Go>()},
      {"step", [](Fields f) { return Ask(asks::Step{count_of(f)}); }},
      {"update", [](Fields f) { return Ask(asks::Update{count_of(f)}); }},
      {"stage", always<asks::Stage>()},
      {"again", always<asks::Again>()},
      {"release", always<asks::Release>()},
      {"speed", speed_of},
      {"back", [](Fields f) { return Ask(asks::Back{f.number("t")}); }},
      {"drive",
       [](Fields f) {
         return Ask(asks::Drive{f.number("v"), f.number("omega")});
       }},
      {"kidnap",
       [](Fields f) {
         return Ask(asks::Kidnap{f.number("x"), f.number("y"), f.number("heading_deg")});
       }},
      {"silence", silence_of},
      {"outlier", [](Fields f) { return Ask(asks::Outlier{f.number("size_sigma")}); }},
      {"ice",
       [](Fields f) {
         return Ask(asks::Ice{f.point("min"), f.point("max"), f.number("friction")});
       }},
      {"wall", [](Fields f) { return Ask(asks::Wall{f.points("points")}); }},
      {"landmark",
       [](Fields f) {
         return Ask(asks::Landmark{f.number("x"), f.number("y")});
       }},
      {"option", option_of},
      {"beside", beside_of},
      {"inspect", inspect_of},
      {"watch", [](Fields f) { return Ask(asks::Watch{f.text("estimator")}); }},
      {"save", save_of},
      {"view", view_of}};
  return all;
}

}  // namespace

Request read_request(std::string_view json) {
  const RequestJson parsed = RequestJson::parse(json, nullptr, false);
  if (!parsed.is_object()) throw BadInput("a request must be a JSON object");
  const RequestFields fields(parsed);
  const auto reader = readers().find(fields.text("do"));
  if (reader == readers().end()) throw BadInput(fmt::format("'do' is unknown: {}", fields.text("do")));
  return {0, fields.has("seq") ? fields.whole("seq") : 0, reader->second(fields)};
}

bool RequestQueue::push(Request request) {
  {
    const std::lock_guard lock(mutex_);
    if (requests_.size() >= most) return false;
    requests_.push_back(std::move(request));
  }
  came_.notify_one();
  return true;
}

std::optional<Request> RequestQueue::pop() {
  const std::lock_guard lock(mutex_);
  if (requests_.empty()) return std::nullopt;
  Request request = std::move(requests_.front());
  requests_.pop_front();
  return request;
}

void RequestQueue::wait_until(std::chrono::steady_clock::time_point end) {
  std::unique_lock lock(mutex_);
  came_.wait_until(lock, end, [this] { return !requests_.empty(); });
}

}  // namespace harness
