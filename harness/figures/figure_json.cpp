#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/files/base64.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Seven digits are more than a screen shows.
std::string numbers(const std::vector<double>& values, bool is_logarithmic) {
  std::string json = "[";
  for (const double value : values) {
    if (json.size() > 1) json += ',';
    const bool is_shown = std::isfinite(value) && !(is_logarithmic && value <= 0.0);
    is_shown ? void(fmt::format_to(std::back_inserter(json), "{:.7g}", value)) : void(json += "null");
  }
  return json + ']';
}

constexpr const char* name_of(Mark mark) {
  switch (mark) {
    case Mark::line:
      return "line";
    case Mark::thin_line:
      return "thin";
    case Mark::points:
      return "points";
    case Mark::circles:
      return "circles";
    case Mark::crosses:
      return "crosses";
  }
  return "";
}

std::string landmarks_json(const LandmarkTips& tips) {
  return fmt::format(R"({{"id":[{}],"true_x":{},"true_y":{},"sd_x":{},"sd_y":{}}})", fmt::join(tips.id, ","),
                     numbers(tips.true_x, false), numbers(tips.true_y, false), numbers(tips.sd_x, false),
                     numbers(tips.sd_y, false));
}

std::string areas_json(const Figure& figure) {
  std::string json;
  for (const FigureArea& area : figure.areas)
    json += fmt::format(R"({}{{"solid":{},"x":{},"y":{}}})", json.empty() ? "" : ",", area.is_solid,
                        numbers(area.x, false), numbers(area.y, false));
  return fmt::format(R"("areas":[{}],"discs":{{"x":{},"y":{},"radius":{}}})", json,
                     numbers(figure.discs.x, false), numbers(figure.discs.y, false),
                     numbers(figure.discs.radius, false));
}

std::string curve_json(const Figure& figure, const FigureCurve& curve) {
  const std::string landmarks =
      curve.landmarks ? ",\"landmarks\":" + landmarks_json(*curve.landmarks) : std::string();
  return fmt::format(
      R"({{"name":{},"colour":"#{:06x}","mark":"{}","hidden":{},"silent":{}{},"x":{},"y":{}}})",
      text(curve.name), curve.colour, name_of(curve.mark), curve.is_hidden, curve.is_silent, landmarks,
      numbers(curve.x, figure.x.is_logarithmic), numbers(curve.y, figure.y.is_logarithmic));
}

Json axis_json(const FigureAxis& axis) { return {{"label", axis.label}, {"log", axis.is_logarithmic}}; }

}  // namespace

std::string to_json(const Figure& figure) {
  Json json = {{"id", figure.id},          {"title", figure.title}, {"x", axis_json(figure.x)},
               {"y", axis_json(figure.y)}, {"map", figure.is_map},  {"categories", figure.categories},
               {"bands", Json::array()}};
  for (const Band& band : figure.bands)
    json["bands"].push_back({{"label", band.label}, {"low", band.low}, {"high", band.high}});
  std::string curves;
  for (const FigureCurve& curve : figure.curves)
    curves += fmt::format("{}{}", curves.empty() ? "" : ",", curve_json(figure, curve));
  std::string whole = text(json);
  whole.pop_back();  // the closing brace
  return fmt::format("{},{},\"curves\":[{}]}}", whole, areas_json(figure), curves);
}

std::string to_json(const MatrixFigure& figure) {
  return text(Json{{"id", figure.id}, {"size", figure.size}, {"cells", base64(figure.cells)}});
}

}  // namespace harness
