// Odometry and scans, as arrays over the memory of the C++ objects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "python/bindings.hpp"

namespace seifbed {

namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

void check_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const std::string& wanted,
                 const std::string& what) {
  const bool fits = std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim());
  if (!fits) throw py::value_error(fmt::format("{} must have the shape {}, not {}", what, wanted, shape_text(array)));
}

void check_finite(const Numbers& numbers, const std::string& what) {
  const bool finite = std::all_of(numbers.data(), numbers.data() + numbers.size(),
                                  [](double value) { return std::isfinite(value); });
  if (!finite) throw py::value_error(fmt::format("{} must be finite", what));
}

seif::Odometry make_odometry(double t, const Numbers& motion, const Numbers& covariance) {
  const Eigen::Matrix3d matrix = matrix_of(covariance, 3, 3, "covariance");
  if (matrix != matrix.transpose() || (matrix.diagonal().array() < 0.0).any())
    throw py::value_error("covariance must be symmetric, with no variance below zero");
  return {t, pose_of(motion, "motion"), matrix};
}

seif::Scan make_scan(double t, const py::array& ids, const Numbers& ranges, const Numbers& bearings,
                     const Numbers& covariances) {
  const seif::LandmarkIds landmarks = ids_of(ids);
  const auto count = static_cast<py::ssize_t>(landmarks.size());
  for (const auto& [numbers, name] : {std::pair(&ranges, "ranges"), std::pair(&bearings, "bearings")}) {
    check_shape(*numbers, {count}, fmt::format("({},)", count), name);
    check_finite(*numbers, name);
  }
  // One covariance for all observations, or one for each.
  const bool one_for_all = covariances.ndim() == 2;
  if (one_for_all) {
    check_shape(covariances, {2, 2}, "(2, 2)", "covariances");
  } else {
    check_shape(covariances, {count, 2, 2}, fmt::format("({}, 2, 2)", count), "covariances");
  }
  check_finite(covariances, "covariances");
  seif::Scan scan{t, {}};
  for (py::ssize_t i = 0; i < count; ++i) {
    const double* c = covariances.data() + (one_for_all ? 0 : 4 * i);
    seif::Observation observation{landmarks[static_cast<std::size_t>(i)], ranges.data()[i], bearings.data()[i], {}};
    observation.covariance << c[0], c[1], c[2], c[3];
    if (!(observation.range > 0.0)) throw py::value_error("ranges must be above zero");
    if (c[1] != c[2] || !(c[0] > 0.0) || !(c[0] * c[3] > c[1] * c[2]))
      throw py::value_error("covariances must be symmetric and positive definite");
    scan.observations.push_back(observation);
  }
  return scan;
}

constexpr py::ssize_t number = sizeof(double);
constexpr py::ssize_t stride = sizeof(seif::Observation);

const seif::Scan& scan_of(const py::object& self) { return self.cast<const seif::Scan&>(); }

template <class T>
py::array_t<T> column_of(const py::object& self, const T seif::Observation::*field) {
  const std::vector<seif::Observation>& seen = scan_of(self).observations;
  if (seen.empty()) return py::array_t<T>(0);
  return view_of<T>(&(seen.front().*field), {std::ssize(seen)}, {stride}, self);
}

py::array_t<double> covariances_of(const py::object& self) {
  const std::vector<seif::Observation>& seen = scan_of(self).observations;
  if (seen.empty()) return py::array_t<double>(std::vector<py::ssize_t>{0, 2, 2});
  return view_of<double>(seen.front().covariance.data(), {std::ssize(seen), 2, 2}, {stride, number, 2 * number}, self);
}

}  // namespace

Eigen::VectorXd vector_of(const Numbers& numbers, Eigen::Index size, const std::string& what) {
  check_shape(numbers, {size}, fmt::format("({},)", size), what);
  check_finite(numbers, what);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), size);
}

Eigen::MatrixXd matrix_of(const Numbers& numbers, Eigen::Index rows, Eigen::Index cols, const std::string& what) {
  check_shape(numbers, {rows, cols}, fmt::format("({}, {})", rows, cols), what);
  check_finite(numbers, what);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(numbers.data(), rows, cols);
}

seif::Pose2 pose_of(const Numbers& numbers, const std::string& what) {
  const Eigen::VectorXd pose = vector_of(numbers, 3, what);
  return {pose(0), pose(1), seif::wrap_angle(pose(2))};
}

Numbers array_of(const seif::Pose2& pose) {
  Numbers numbers(3);
  double* const data = numbers.mutable_data();
  data[0] = pose.x;
  data[1] = pose.y;
  data[2] = pose.theta;
  return numbers;
}

seif::LandmarkIds ids_of(const py::array& numbers) {
  if (numbers.size() > 0 && numbers.dtype().kind() != 'i' && numbers.dtype().kind() != 'u')
    throw py::type_error("ids must be whole numbers");
  if (numbers.ndim() != 1) throw py::value_error("ids must have the shape (n,), not " + shape_text(numbers));
  const auto whole = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(numbers);
  seif::LandmarkIds ids;
  for (py::ssize_t i = 0; i < whole.size(); ++i) {
    const std::int64_t id = whole.data()[i];
    if (id < 0 || id >= std::numeric_limits<seif::LandmarkId>::max())
      throw py::value_error(fmt::format("ids: {} is no landmark; the lowest is 0", id));
    ids.push_back(static_cast<seif::LandmarkId>(id));
  }
  seif::LandmarkIds sorted = ids;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    throw py::value_error(fmt::format("ids: {} occurs twice", *twice));
  return ids;
}

void bind_measurements(py::module_& module) {
  using namespace py::literals;
  py::class_<seif::Odometry>(module, "Odometry", "The motion since the last reading, in the robot's frame before it.")
      .def(py::init(&make_odometry), "t"_a, "motion"_a, "covariance"_a)
      .def_readonly("t", &seif::Odometry::t, "Time at its end [s].")
      .def_property_readonly(
          "motion",
          [](const py::object& self) {
            const auto& motion = self.cast<const seif::Odometry&>().T_previous_current;
            return view_of<double>(&motion.x, {3}, {number}, self);
          },
          "(3,) forward, left, turn [m, m, rad]; a view.")
      .def_property_readonly(
          "covariance",
          [](const py::object& self) {
            const auto& covariance = self.cast<const seif::Odometry&>().covariance;
            return view_of<double>(covariance.data(), {3, 3}, {number, 3 * number}, self);
          },
          "(3, 3) of the motion [m, rad]; a view.");
  py::class_<seif::Scan>(module, "Scan", "The landmarks that the sensor sees at one time.")
      .def(py::init(&make_scan), "t"_a, "ids"_a, "ranges"_a, "bearings"_a, "covariances"_a)
      .def_readonly("t", &seif::Scan::t, "Time [s].")
      .def("__len__", [](const seif::Scan& scan) { return scan.observations.size(); })
      .def_property_readonly(
          "ids", [](const py::object& self) { return column_of<seif::LandmarkId>(self, &seif::Observation::landmark); },
          "(n,) landmarks; -1: not known; a view.")
      .def_property_readonly(
          "ranges", [](const py::object& self) { return column_of<double>(self, &seif::Observation::range); },
          "(n,) [m]; a view.")
      .def_property_readonly(
          "bearings", [](const py::object& self) { return column_of<double>(self, &seif::Observation::bearing); },
          "(n,) [rad], counter-clockwise from the sensor's x; a view.")
      .def_property_readonly("covariances", &covariances_of, "(n, 2, 2) of range and bearing [m, rad]; a view.");
}

}  // namespace seifbed
