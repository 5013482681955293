#include "harness/live/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "harness/estimators/plugins.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/files/output_file.hpp"
#include "harness/run/option_changes.hpp"
#include "harness/run/prepared_run.hpp"
#include "seif/make_estimator.hpp"
#include "worlds/document.hpp"
#include "worlds/merge.hpp"
#include "worlds/read_fault.hpp"

namespace harness {

namespace {

constexpr const char* takeover_file = "takeover.csv";
constexpr std::size_t most_faults = 1000;     // [-] of a world file
constexpr std::size_t most_rows = 1'000'000;  // [-] of commands
constexpr std::size_t most_estimators = 12;   // [-]

std::string_view name_of(worlds::FaultySensor sensor) {
  return sensor == worlds::FaultySensor::encoders ? "encoders" : "landmark_sensor";
}

std::string silence_yaml(worlds::FaultySensor sensor, double at, double duration) {
  return fmt::format("{{kind: silence, at_s: {}, sensor: {}, duration_s: {}}}", at, name_of(sensor),
                     duration);
}

std::string text_of(const seif::OptionValue& value) {
  return std::visit(
      [](const auto& v) {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::string>) return fmt::format("\"{}\"", v);
        return fmt::format("{}", v);
      },
      value);
}

/// As it stands in the section `estimators` of a world file.
std::string yaml_of(const worlds::EstimatorChoice& choice) {
  std::string yaml = fmt::format("{{type: {}, odometry_sd_factor: {}, observation_sd_factor: {}", choice.type,
                                 choice.odometry_sd_factor, choice.observation_sd_factor);
  if (!choice.library.empty()) yaml += fmt::format(", library: \"{}\"", choice.library);
  for (const auto& [key, value] : choice.options) yaml += fmt::format(", {}: {}", key, text_of(value));
  return yaml + '}';
}

/// In the order of time; a row of the same time is replaced.
void put(std::vector<worlds::Takeover>& rows, const worlds::Takeover& row) {
  const auto place = std::ranges::lower_bound(rows, row.t, {}, &worlds::Takeover::t);
  if (place != rows.end() && place->t == row.t) {
    *place = row;
  } else {
    rows.insert(place, row);
  }
}

/// Throws BadInput for an option that the type does not have, and for a value that is not valid.
void set_option(worlds::EstimatorChoice& choice, const std::string& option, const seif::OptionValue& value,
                const seif::EstimatorType& type) {
  if (option == odometry_factor || option == observation_factor) {
    const double factor = std::holds_alternative<double>(value) ? std::get<double>(value) : 0.0;
    const OptionChange change{0.0, choice.name, option, factor};
    if (!(factor >= 1.0 / worlds::largest_sd_factor && factor <= worlds::largest_sd_factor))
      throw BadInput(fmt::format("'{}' must be a positive number", option));
    return apply(change, choice);
  }
  const auto spec = std::ranges::find(type.options, option, &seif::OptionSpec::key);
  const bool is_whole = spec != type.options.end() && std::holds_alternative<std::int64_t>(spec->fallback) &&
                        std::holds_alternative<double>(value) &&
                        std::get<double>(value) == std::round(std::get<double>(value));
  seif::Options options = choice.options;
  options[option] = is_whole ? seif::OptionValue(std::llround(std::get<double>(value))) : value;
  try {
    choice.options = seif::complete_options(type, options);
  } catch (const std::invalid_argument& error) {
    throw BadInput(error.what());
  }
}

std::string free_name(const worlds::World& world, const std::string& wanted) {
  std::string name = wanted;
  const auto is_taken = [&] {
    return std::ranges::find(world.estimators, name, &worlds::EstimatorChoice::name) !=
           world.estimators.end();
  };
  for (int number = 2; is_taken(); ++number) name = fmt::format("{}_{}", wanted, number);
  return name;
}

}  // namespace

Script::Script(worlds::World world, std::string resolved, const seif::Registry& registry)
    : registry_(&registry), base_(std::move(world)), resolved_(std::move(resolved)), world_(base_) {}

void Script::rebuild() {
  world_.faults = base_.faults;
  for (const Done& done : faults_) world_.faults.push_back(done.fault);
  world_.drive.takeover = base_.drive.takeover;
  for (const worlds::Takeover& row : takeover_) put(world_.drive.takeover, row);
  world_.estimators = base_.estimators;
  for (const worlds::EstimatorChoice& choice : beside_) world_.estimators.push_back(choice);
}

bool Script::goes_on_after(double t) const {
  return std::ranges::any_of(faults_, [t](const Done& done) { return done.fault.at > t; }) ||
         (!takeover_.empty() && takeover_.back().t > t);
}

void Script::cut_after(double t) {
  std::erase_if(faults_, [t](const Done& done) { return done.fault.at > t; });
  std::erase_if(takeover_, [t](const worlds::Takeover& row) { return row.t > t; });
  rebuild();
}

const worlds::Fault& Script::add_fault(const std::string& yaml) {
  if (world_.faults.size() >= most_faults) throw BadInput("a world can have 1,000 faults, and no more");
  std::vector<worlds::Problem> problems;
  const std::optional<worlds::Fault> fault = worlds::read_fault(yaml, world_, problems);
  if (!fault) throw BadInput(problems.empty() ? "this is no fault" : problems.front().message);
  if (fault->kind == worlds::FaultKind::option) {
    const OptionChange change{fault->at, fault->estimator, fault->option, fault->option_value};
    const auto choice =
        std::ranges::find(world_.estimators, change.estimator, &worlds::EstimatorChoice::name);
    if (choice == world_.estimators.end())
      throw BadInput(fmt::format("there is no estimator '{}'", change.estimator));
    worlds::EstimatorChoice now = *choice;
    for (const OptionChange& earlier : option_changes(world_)) {
      if (earlier.estimator == now.name) apply(earlier, now);
    }
    if (const auto why = fault_of_change(*registry_, now, change)) throw BadInput(*why);
  }
  faults_.push_back({yaml, *fault});
  world_.faults.push_back(*fault);
  return faults_.back().fault;
}

void Script::take_back() {
  faults_.pop_back();
  rebuild();
}

const worlds::Fault& Script::begin_silence(worlds::FaultySensor sensor, double t) {
  return add_fault(silence_yaml(sensor, t, worlds::open_end));
}

bool Script::has_begun_silence(worlds::FaultySensor sensor) const {
  return std::ranges::any_of(faults_, [sensor](const Done& done) {
    return done.fault.kind == worlds::FaultKind::silence && done.fault.sensor == sensor &&
           done.fault.duration == worlds::open_end;
  });
}

void Script::end_silence(worlds::FaultySensor sensor, double t) {
  for (auto& [yaml, fault] : faults_) {
    if (fault.kind != worlds::FaultKind::silence || fault.sensor != sensor ||
        fault.duration != worlds::open_end)
      continue;
    fault.duration = t - fault.at;
    yaml = silence_yaml(sensor, fault.at, fault.duration);
  }
  std::erase_if(faults_, [](const Done& done) {  // begun and ended in the same moment
    return done.fault.kind == worlds::FaultKind::silence && done.fault.duration <= 0.0;
  });
  rebuild();
}

void Script::take_over(const worlds::Takeover& row) {
  if (takeover_.size() >= most_rows) throw BadInput("a run can have a million commands, and no more");
  put(takeover_, row);
  put(world_.drive.takeover, row);
}

std::string Script::add_beside(const std::string& estimator, const std::string& option,
                               const seif::OptionValue& value) {
  const auto original = std::ranges::find(world_.estimators, estimator, &worlds::EstimatorChoice::name);
  if (original == world_.estimators.end())
    throw BadInput(fmt::format("there is no estimator '{}'", estimator));
  if (world_.estimators.size() >= most_estimators)
    throw BadInput(fmt::format("{} estimators run already, and no more can", most_estimators));
  worlds::EstimatorChoice copy = *original;
  set_option(copy, option, value, type_of(*registry_, copy));
  copy.name = free_name(world_, fmt::format("{}_{}", original->type, option));
  beside_.push_back(copy);
  rebuild();
  return copy.name;
}

void Script::write(const std::filesystem::path& folder, double t) const {
  std::vector<worlds::Problem> problems;
  std::optional<worlds::Node> document = worlds::parse_document(resolved_, "world.yaml", problems);
  if (!document) throw BadInput(worlds::to_string(problems.front()));
  worlds::apply_override(*document, fmt::format("duration_s={}", t), problems);
  if (!faults_.empty() && document->find("faults") == nullptr)
    worlds::apply_override(*document, "faults=[]", problems);
  for (const Done& done : faults_) {
    if (done.fault.at > t) continue;
    document->find("faults")->kind = worlds::Node::Kind::sequence;
    document->find("faults")->items.push_back(*worlds::parse_document(done.yaml, "fault", problems));
  }
  if (!world_.drive.takeover.empty())
    worlds::apply_override(*document, fmt::format("drive.takeover_file={}", takeover_file), problems);
  for (const worlds::EstimatorChoice& choice : beside_)
    worlds::apply_override(*document, fmt::format("estimators.{}={}", choice.name, yaml_of(choice)),
                           problems);
  if (!problems.empty()) throw BadInput(worlds::to_string(problems.front()));

  worlds::World written = base_;
  written.drive.takeover_file.clear();  // the rows are those below
  write_world(folder, written, worlds::emit(*document));
  if (world_.drive.takeover.empty()) return;
  std::string rows = "t,v,omega\n";
  for (const worlds::Takeover& row : world_.drive.takeover) {
    if (row.t > t) break;
    rows += row.released ? fmt::format("{},,\n", row.t) : fmt::format("{},{},{}\n", row.t, row.v, row.omega);
  }
  write_whole_file(folder / takeover_file, rows);
}

}  // namespace harness
