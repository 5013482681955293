// An estimator whose functions are those of a Python object.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "python/bindings.hpp"
#include "seif/marginals.hpp"

namespace seifbed {

namespace {

/// An exception of Python in one line: what it says, and the innermost places from which it came.
std::string one_line(const py::error_already_set& error) {
  std::string text = error.what();  // pybind11 lists the places in lines of their own, the innermost first
  constexpr std::size_t most_places = 4;
  const std::size_t at = text.find("\n\nAt:\n");
  std::string places;
  if (at != std::string::npos) {
    std::istringstream lines(text.substr(at + 6));
    std::string line;
    for (std::size_t i = 0; i < most_places && std::getline(lines, line); ++i)
      places += fmt::format("{}{}", i == 0 ? " at " : ", called from ",
                            line.substr(std::min<std::size_t>(2, line.size())));
    text.resize(at);
  }
  std::ranges::replace(text, '\n', ' ');
  return text + places;
}

/// Calls Python, and turns an exception of Python into one that needs no interpreter.
template <class Call>
auto in_python(const char* function, const Call& call) {
  const py::gil_scoped_acquire gil;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    throw std::runtime_error(fmt::format("{}: {}", function, one_line(error)));
  } catch (const py::builtin_exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", function, error.what()));
  }
}

class PythonEstimator final : public seif::Estimator {
 public:
  explicit PythonEstimator(py::object object)
      : object_(std::move(object)),
        motion_(object_.attr("motion")),
        measure_(object_.attr("measure")),
        pose_(object_.attr("pose")),
        map_(object_.attr("map")) {
    if (py::hasattr(object_, "covariance")) covariance_ = object_.attr("covariance");
  }
  ~PythonEstimator() override {
    const py::gil_scoped_acquire gil;
    for (py::object* part : {&covariance_, &map_, &pose_, &measure_, &motion_, &object_})
      *part = py::object();
  }
  PythonEstimator(const PythonEstimator&) = delete;
  PythonEstimator& operator=(const PythonEstimator&) = delete;

  void motion_update(const seif::Odometry& odometry) override {
    in_python("motion", [&] { motion_(odometry); });
  }

  void measurement_update(const seif::Scan& scan, const seif::StageDone& done) override {
    in_python("measure", [&] { measure_(scan); });
    done(seif::Stage::measurement);
  }

  seif::Pose2 pose() const override {
    constexpr const char* what = "the pose that pose() returns";
    return in_python("pose", [&] { return pose_of(numbers_of(pose_(), what), what); });
  }

  std::optional<Eigen::Matrix3d> pose_covariance() const override {
    const std::optional<Eigen::MatrixXd> joint = joint_of({});
    return joint ? std::optional<Eigen::Matrix3d>(*joint) : std::nullopt;
  }

  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return 0; }  // only Python knows

  /// map() returns a dictionary {landmark: (x, y)}.
  std::vector<seif::LandmarkEstimate> map() const override {
    return in_python("map", [&] {
      std::vector<seif::LandmarkEstimate> map;
      for (const auto& [id, position] : py::dict(map_())) {
        constexpr const char* what = "a position in the map that map() returns";
        map.push_back(
            {id_of(id), vector_of(numbers_of(py::reinterpret_borrow<py::object>(position), what), 2, what)});
      }
      return map;
    });
  }

  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId> landmarks) const override {
    seif::MarginalCovariances marginals;
    const std::optional<Eigen::MatrixXd> joint = joint_of({landmarks.begin(), landmarks.end()});
    if (!joint) return std::nullopt;
    marginals.pose = joint->topLeftCorner<3, 3>();
    for (Eigen::Index row = 3; row < joint->rows(); row += 2)
      marginals.landmarks.emplace_back(joint->block<2, 2>(row, row));
    return marginals;
  }

  std::optional<std::vector<Eigen::MatrixXd>> joint_covariances(
      std::span<const seif::LandmarkIds> groups) const override {
    std::vector<Eigen::MatrixXd> joint;
    for (const seif::LandmarkIds& group : groups) {
      std::optional<Eigen::MatrixXd> one = joint_of(group);
      if (!one) return std::nullopt;
      joint.push_back(std::move(*one));
    }
    return joint;
  }

 private:
  /// covariance(ids) returns the covariance of the pose and these landmarks, (3+2k, 3+2k), or None.
  std::optional<Eigen::MatrixXd> joint_of(const seif::LandmarkIds& ids) const {
    if (!covariance_) return std::nullopt;
    return in_python("covariance", [&]() -> std::optional<Eigen::MatrixXd> {
      const py::array_t<seif::LandmarkId> numbers(std::ssize(ids), ids.data());
      const py::object returned = covariance_(numbers);
      if (returned.is_none()) return std::nullopt;
      const Eigen::Index size = 3 + 2 * static_cast<Eigen::Index>(ids.size());
      return covariance_of(numbers_of(returned, "what covariance() returns"), size,
                           "what covariance() returns");
    });
  }

  py::object object_;
  py::object motion_, measure_, pose_, map_;  // its functions, looked up once
  py::object covariance_;                     // null: it has none
};

seif::OptionSpec spec_of(const std::string& key, const seif::OptionValue& fallback) {
  return {.key = key, .fallback = fallback, .help = "An option of the Python class."};
}

/// The same values as Python's.
py::dict keywords_of(const seif::Options& options) {
  py::dict keywords;
  for (const auto& [key, value] : options) keywords[py::str(key)] = py::cast(value);
  return keywords;
}

struct MakeInPython {
  /// Never released: the registry lives as long as the program, and longer than the interpreter.
  py::handle make;

  std::unique_ptr<seif::Estimator> operator()(const seif::EstimatorSetup& setup,
                                              const seif::Options& options) const {
    return in_python("the constructor", [&] {
      return std::make_unique<PythonEstimator>(make(array_of(setup.start.mean),
                                                    py::cast(setup.start.covariance),
                                                    array_of(setup.T_robot_sensor), keywords_of(options)));
    });
  }
};

}  // namespace

void add_python_estimator(seif::Registry& registry, const std::string& name, const std::string& help,
                          const py::dict& defaults, const py::object& make) {
  std::vector<seif::OptionSpec> specs;
  for (const auto& [key, value] : options_of(defaults)) specs.push_back(spec_of(key, value));
  registry.add({.name = name, .help = help, .options = specs, .make = MakeInPython{make.inc_ref()}});
}

bool is_in_python(const seif::EstimatorType& type) { return type.make.target<MakeInPython>() != nullptr; }

}  // namespace seifbed
