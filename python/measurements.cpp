// Odometry and scans, as arrays over the memory of the C++ objects.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "harness/stream/covariance_limits.hpp"
#include "python/bindings.hpp"

namespace seifbed {

namespace {

constexpr double asymmetry = 1e-6;  // [-] of rounding, against the largest element; single precision has less

constexpr double largest = 1e9;  // [m, rad] in a motion or an observation

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

void check_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const std::string& wanted,
                 const std::string& what) {
  const bool fits = std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim());
  if (!fits)
    throw py::value_error(fmt::format("{} must have the shape {}, not {}", what, wanted, shape_text(array)));
}

void check_finite(const Numbers& numbers, const std::string& what) {
  const bool finite = std::all_of(numbers.data(), numbers.data() + numbers.size(),
                                  [](double value) { return std::isfinite(value); });
  if (!finite) throw py::value_error(fmt::format("{} must be finite", what));
}

void check_time(double t) {
  if (!std::isfinite(t)) throw py::value_error("t must be finite");
}

/// No filter can work with what its squares make overflow or round to nothing.
void check_size(const Numbers& numbers, const std::string& what) {
  const bool small = std::all_of(numbers.data(), numbers.data() + numbers.size(),
                                 [](double value) { return std::abs(value) <= largest; });
  if (!small) throw py::value_error(fmt::format("{} must be at most {:g}", what, largest));
}

void refuse(const std::string& problem, const std::string& what) {
  if (!problem.empty()) throw py::value_error(what + ": " + problem);
}

seif::Odometry make_odometry(double t, const py::object& motion, const py::object& covariance) {
  check_time(t);
  const Eigen::Matrix3d matrix = covariance_of(numbers_of(covariance, "covariance"), 3, "covariance");
  // A robot that cannot move sideways has a covariance of rank two: rounding may make its least eigenvalue negative.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d variances = solver.eigenvalues();  // ascending
  if (variances(0) < -1e-9 * std::max(variances(2), 0.0) || variances(2) < 0.0)
    throw py::value_error("covariance: a variance is below zero");
  refuse(harness::problem_of_motion(matrix), "covariance");
  const Numbers moved = numbers_of(motion, "motion");
  const seif::Pose2 pose = pose_of(moved, "motion");
  check_size(moved, "motion");
  return {t, pose, matrix};
}

/// The covariance of one observation.
Eigen::Matrix2d observation_covariance(const double* c) {
  Eigen::Matrix2d covariance;
  const double mean = 0.5 * (c[1] + c[2]);
  covariance << c[0], mean, mean, c[3];
  if (!(std::abs(c[1] - c[2]) <= asymmetry * covariance.cwiseAbs().maxCoeff()))
    throw py::value_error("covariances must be symmetric");
  refuse(harness::problem_of_observation(covariance), "covariances");
  return covariance;
}

seif::Scan make_scan(double t, const py::object& ids, const py::object& given_ranges,
                     const py::object& given_bearings, const py::object& given_covariances) {
  check_time(t);
  const seif::LandmarkIds landmarks = ids_of(ids);
  const Numbers ranges = numbers_of(given_ranges, "ranges");
  const Numbers bearings = numbers_of(given_bearings, "bearings");
  const Numbers covariances = numbers_of(given_covariances, "covariances");
  const auto count = static_cast<py::ssize_t>(landmarks.size());
  for (const auto& [numbers, name] : {std::pair(&ranges, "ranges"), std::pair(&bearings, "bearings")}) {
    check_shape(*numbers, {count}, fmt::format("({},)", count), name);
    check_finite(*numbers, name);
    check_size(*numbers, name);
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
    if (!(ranges.data()[i] > 0.0)) throw py::value_error("ranges must be above zero");
    scan.observations.push_back({landmarks[static_cast<std::size_t>(i)], ranges.data()[i], bearings.data()[i],
                                 observation_covariance(c)});
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
  return view_of<double>(seen.front().covariance.data(), {std::ssize(seen), 2, 2},
                         {stride, number, 2 * number}, self);
}

}  // namespace

Numbers numbers_of(const py::object& numbers, const std::string& what) {
  if (Numbers::check_(numbers)) return py::reinterpret_borrow<Numbers>(numbers);
  const py::array array = py::array::ensure(numbers);
  if (!array) throw py::value_error(what + " must be numbers in rows of equal length");
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw py::value_error(fmt::format("{} must be numbers, not of the type {}", what,
                                      py::str(array.dtype()).cast<std::string>()));
  return Numbers::ensure(array);
}

Eigen::MatrixXd covariance_of(const Numbers& numbers, Eigen::Index size, const std::string& what) {
  const Eigen::MatrixXd matrix = matrix_of(numbers, size, size, what);
  const double difference = (matrix - matrix.transpose()).cwiseAbs().maxCoeff();
  if (difference > asymmetry * matrix.cwiseAbs().maxCoeff())
    throw py::value_error(what + " must be symmetric");
  return 0.5 * (matrix + matrix.transpose());
}

Eigen::VectorXd vector_of(const Numbers& numbers, Eigen::Index size, const std::string& what) {
  check_shape(numbers, {size}, fmt::format("({},)", size), what);
  check_finite(numbers, what);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), size);
}

Eigen::MatrixXd matrix_of(const Numbers& numbers, Eigen::Index rows, Eigen::Index cols,
                          const std::string& what) {
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

seif::LandmarkId id_of(const py::handle& number) {
  const py::object whole = py::reinterpret_steal<py::object>(PyNumber_Index(number.ptr()));
  if (!whole) throw py::error_already_set();
  int overflow = 0;
  const long long id = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow != 0 || id < 0 || id >= std::numeric_limits<seif::LandmarkId>::max())
    throw py::value_error(py::str(number).cast<std::string>() + " is no landmark; the lowest is 0");
  return static_cast<seif::LandmarkId>(id);
}

seif::LandmarkIds ids_of(const py::object& given) {
  const py::array numbers = py::array::ensure(given);
  if (!numbers) throw py::value_error("ids must be whole numbers in a row");
  const char kind = numbers.dtype().kind();
  if (numbers.size() > 0 && kind != 'i' && kind != 'u') throw py::type_error("ids must be whole numbers");
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
  py::class_<seif::Odometry>(module, "Odometry",
                             "The motion since the last reading, in the robot's frame before it.")
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
          "ids",
          [](const py::object& self) {
            return column_of<seif::LandmarkId>(self, &seif::Observation::landmark);
          },
          "(n,) landmarks; -1: not known; a view.")
      .def_property_readonly(
          "ranges", [](const py::object& self) { return column_of<double>(self, &seif::Observation::range); },
          "(n,) [m]; a view.")
      .def_property_readonly(
          "bearings",
          [](const py::object& self) { return column_of<double>(self, &seif::Observation::bearing); },
          "(n,) [rad], counter-clockwise from the sensor's x; a view.")
      .def_property_readonly("covariances", &covariances_of,
                             "(n, 2, 2) of range and bearing [m, rad]; a view.");
}

}  // namespace seifbed
