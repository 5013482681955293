// What the parts of the compiled module tell each other.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seif/estimator.hpp"
#include "seif/registry.hpp"

namespace seifbed {

namespace py = pybind11;

/// Numbers of Python in rows, converted to double where they are not.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Each adds its part to the module.
void bind_measurements(py::module_& module);
void bind_filter(py::module_& module);
void bind_environment(py::module_& module);
void bind_runs(py::module_& module);
void bind_scores(py::module_& module);

/// An array or a list of real numbers. Throws ValueError, which calls it `what`, if it is none.
Numbers numbers_of(const py::object& numbers, const std::string& what);

/// The vector or matrix of these numbers. Throws ValueError, which calls it `what`, if the shape is another one or a
/// number is not finite.
Eigen::VectorXd vector_of(const Numbers& numbers, Eigen::Index size, const std::string& what);
Eigen::MatrixXd matrix_of(const Numbers& numbers, Eigen::Index rows, Eigen::Index cols,
                          const std::string& what);

/// A covariance without what rounding has made asymmetric. Throws ValueError if it is more than that.
Eigen::MatrixXd covariance_of(const Numbers& numbers, Eigen::Index size, const std::string& what);

seif::Pose2 pose_of(const Numbers& numbers, const std::string& what);
Numbers array_of(const seif::Pose2& pose);  // (3,)

/// The landmarks of a scan or a map. Throws TypeError for what is no whole number, ValueError for a number below zero
/// and for one that occurs twice.
seif::LandmarkIds ids_of(const py::object& numbers);
seif::LandmarkId id_of(const py::handle& number);

/// The options of an estimator from keywords. Throws TypeError for a value that is no bool, int, float or str.
seif::Options options_of(const py::dict& keywords);

/// An array over memory that `owner` keeps alive. It cannot be written to.
template <class T>
py::array_t<T> view_of(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                       const py::object& owner) {
  py::array_t<T> view(std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

/// Adds an estimator that is a class of Python. `make(start, T_robot_sensor, options)` returns an object of it.
void add_python_estimator(seif::Registry& registry, const std::string& name, const std::string& help,
                          const py::dict& defaults, const py::object& make);

/// Whether the type is a class of Python.
bool is_in_python(const seif::EstimatorType& type);

/// The estimators of the program, of the plug-ins, and those that are classes of Python. Not a copy: it may grow.
seif::Registry& known_registry();

}  // namespace seifbed
