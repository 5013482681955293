// One filter alone, on data of one's own.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "harness/stream/covariance_limits.hpp"
#include "python/bindings.hpp"
#include "seif/make_estimator.hpp"

namespace seifbed {

namespace {

constexpr std::array<const char*, 4> stage_names = {"motion", "measurement", "sparsification",
                                                    "mean_recovery"};

seif::OptionValue option_value(const std::string& key, const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::int_>(value)) {
    int overflow = 0;
    const long long whole = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
    if (overflow != 0) throw py::value_error(key + " is too large");
    return std::int64_t{whole};
  }
  if (py::isinstance<py::float_>(value)) return value.cast<double>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  throw py::type_error(key + " must be a bool, an int, a float or a str");
}

/// What a filter believes when a stage of its update has ended.
struct StageSnapshot {
  std::string name;
  Eigen::MatrixXd matrix;  // (3+2N x 3+2N); empty if the filter stores none
  std::vector<int> links;  // landmarks with an element of the matrix in the robot's row
  seif::Pose2 pose;
};

StageSnapshot snapshot_of(const seif::Estimator& filter, seif::Stage stage) {
  StageSnapshot snapshot{
      stage_names.at(static_cast<std::size_t>(stage)), filter.whole_belief_matrix(), {}, filter.pose()};
  std::vector<seif::Coupling> couplings;
  filter.couplings(seif::no_landmark, couplings);
  for (const seif::Coupling& coupling : couplings) snapshot.links.push_back(coupling.other);
  return snapshot;
}

/// What a filter is told before its first motion. Throws ValueError for a start that no filter can work with.
seif::EstimatorSetup setup_of(const py::object& start, const py::object& start_covariance,
                              const py::object& sensor, std::uint64_t seed) {
  const Eigen::Matrix3d covariance =
      covariance_of(numbers_of(start_covariance, "start_covariance"), 3, "start_covariance");
  if (const std::string problem = harness::problem_of_start(covariance); !problem.empty())
    throw py::value_error("start_covariance: " + problem);
  return {{pose_of(numbers_of(start, "start"), "start"), covariance},
          pose_of(numbers_of(sensor, "sensor"), "sensor"),
          std::mt19937_64(seed)};
}

/// A filter and the motions that its next scan will process.
class Filter {
 public:
  Filter(const std::string& name, const py::object& start, const py::object& start_covariance,
         const py::object& sensor, std::uint64_t seed, const py::dict& options)
      : filter_(seif::make_estimator(known_registry(), name, setup_of(start, start_covariance, sensor, seed),
                                     options_of(options))) {}

  void motion(const seif::Odometry& odometry) { filter_->motion_update(odometry); }

  void measure(const seif::Scan& scan) {
    check_names(scan);
    filter_->measurement_update(scan, [](seif::Stage) {});
  }

  std::vector<StageSnapshot> stages(const seif::Scan& scan) {
    check_names(scan);
    std::vector<StageSnapshot> snapshots = {snapshot_of(*filter_, seif::Stage::motion)};
    filter_->measurement_update(
        scan, [&](seif::Stage stage) { snapshots.push_back(snapshot_of(*filter_, stage)); });
    return snapshots;
  }

  /// (ids (n,), means (n, 2)), in the order in which the landmarks joined.
  py::tuple map() const {
    const std::vector<seif::LandmarkEstimate> map = filter_->map();
    py::array_t<seif::LandmarkId> ids(std::ssize(map));
    py::array_t<double> means(std::vector<py::ssize_t>{std::ssize(map), 2});
    for (std::size_t i = 0; i < map.size(); ++i) {
      ids.mutable_data()[i] = map[i].landmark;
      means.mutable_data()[2 * i] = map[i].mean.x();
      means.mutable_data()[2 * i + 1] = map[i].mean.y();
    }
    return py::make_tuple(ids, means);
  }

  /// The joint covariance of the pose and these landmarks; None if the filter has none. (3+2k, 3+2k)
  py::object covariance(const py::object& numbers) const {
    const seif::LandmarkIds ids = ids_of(numbers);
    check_mapped(ids);
    auto joint = filter_->joint_covariances(std::span(&ids, 1));
    if (!joint) return py::none();
    return py::cast(std::move(joint->front()));
  }

  /// (pose (3, 3), landmarks (k, 2, 2)); None if the filter has none.
  py::object covariances(const py::object& numbers) const {
    const seif::LandmarkIds ids = ids_of(numbers);
    check_mapped(ids);
    const auto marginals = filter_->marginal_covariances(ids);
    if (!marginals) return py::none();
    py::array_t<double> landmarks(std::vector<py::ssize_t>{std::ssize(ids), 2, 2});
    for (std::size_t i = 0; i < ids.size(); ++i)
      std::memcpy(landmarks.mutable_data() + 4 * i, marginals->landmarks[i].data(), 4 * sizeof(double));
    return py::make_tuple(marginals->pose, landmarks);
  }

  const seif::Estimator& estimator() const { return *filter_; }

 private:
  void check_names(const seif::Scan& scan) const {
    if (!filter_->needs_names()) return;
    for (const seif::Observation& observation : scan.observations) {
      if (observation.landmark == seif::no_landmark)
        throw py::value_error("the scan does not say which landmarks it shows, and this filter needs that");
    }
  }

  void check_mapped(const seif::LandmarkIds& ids) const {
    std::vector<seif::LandmarkEstimate> found;
    filter_->landmarks(ids, found);
    if (found.size() != ids.size()) throw py::value_error("ids: not all of these landmarks are in the map");
  }

  std::unique_ptr<seif::Estimator> filter_;
};

py::dict counts_of(const Filter& filter) {
  using namespace py::literals;
  const seif::Counts counts = filter.estimator().counts();
  return py::dict("blocks_touched"_a = counts.blocks_touched, "active_landmarks"_a = counts.active_landmarks,
                  "links"_a = counts.links, "relocations"_a = counts.relocations, "gated"_a = counts.gated,
                  "innovation"_a = counts.innovation, "innovation_degrees"_a = counts.innovation_degrees);
}

py::list estimator_list() {
  using namespace py::literals;
  py::list types;
  for (const seif::EstimatorType& type : known_registry().types()) {
    py::dict options;
    for (const seif::OptionSpec& spec : type.options) options[py::str(spec.key)] = py::cast(spec.fallback);
    types.append(py::dict("name"_a = type.name, "help"_a = type.help, "options"_a = options));
  }
  return types;
}

}  // namespace

seif::Options options_of(const py::dict& keywords) {
  seif::Options options;
  for (const auto& [key, value] : keywords) {
    const auto name = key.cast<std::string>();
    options[name] = option_value(name, value);
  }
  return options;
}

void bind_filter(py::module_& module) {
  using namespace py::literals;
  py::class_<StageSnapshot>(module, "Stage", "What a filter believed when a stage of its update had ended.")
      .def_readonly("name", &StageSnapshot::name, "motion, measurement, sparsification or mean_recovery.")
      .def_property_readonly(
          "information", [](const StageSnapshot& stage) -> const Eigen::MatrixXd& { return stage.matrix; },
          py::return_value_policy::reference_internal,
          "(3+2N, 3+2N), rows [x y theta m1x m1y ...]; a view. A covariance for an EKF, empty for a filter "
          "without one.")
      .def_readonly("links", &StageSnapshot::links, "Landmarks that have a link to the robot.")
      .def_property_readonly(
          "pose", [](const StageSnapshot& stage) { return array_of(stage.pose); }, "(3,) [m, m, rad].");
  py::class_<Filter>(module, "Filter", "A filter alone, by its name.")
      .def(py::init<const std::string&, const py::object&, const py::object&, const py::object&,
                    std::uint64_t, const py::dict&>(),
           "name"_a, "start"_a, "start_covariance"_a, "sensor"_a, "seed"_a, "options"_a)
      .def("motion", &Filter::motion, "odometry"_a)
      .def("measure", &Filter::measure, "scan"_a)
      .def("stages", &Filter::stages, "scan"_a)
      .def("map", &Filter::map)
      .def("covariance", &Filter::covariance, "ids"_a)
      .def("covariances", &Filter::covariances, "ids"_a)
      .def("pose", [](const Filter& filter) { return array_of(filter.estimator().pose()); })
      .def("information", [](const Filter& filter) { return filter.estimator().whole_belief_matrix(); })
      .def("counts", &counts_of);
  module.def("estimators", &estimator_list);
}

}  // namespace seifbed
