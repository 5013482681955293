// Scores of anybody's results, from values.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/score/foreign.hpp"
#include "python/bindings.hpp"

namespace seifbed {

namespace {

/// Rows of t, x, y, theta.
std::vector<harness::TimedPose> poses_of(const Numbers& rows, const std::string& what) {
  const Eigen::MatrixXd values = matrix_of(rows, rows.ndim() > 0 ? rows.shape(0) : 0, 4, what);
  std::vector<harness::TimedPose> poses;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (i > 0 && values(i, 0) < values(i - 1, 0))
      throw py::value_error(what + " must be in the order of time");
    poses.push_back({values(i, 0), {values(i, 1), values(i, 2), seif::wrap_angle(values(i, 3))}});
  }
  return poses;
}

/// The matrices of an array (n, size, size). A matrix with a NaN is missing.
template <int size>
std::vector<std::optional<Eigen::Matrix<double, size, size>>> matrices_of(
    const std::optional<Numbers>& numbers, std::size_t count, const std::string& what) {
  using Matrix = Eigen::Matrix<double, size, size>;
  std::vector<std::optional<Matrix>> matrices(count);
  if (!numbers) return matrices;
  const bool fits = numbers->ndim() == 3 && numbers->shape(0) == static_cast<py::ssize_t>(count) &&
                    numbers->shape(1) == size && numbers->shape(2) == size;
  if (!fits)
    throw py::value_error(what + " must have the shape (n, " + std::to_string(size) + ", " +
                          std::to_string(size) + "), with n = " + std::to_string(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Matrix matrix = Eigen::Map<const Matrix>(numbers->data() + i * size * size);
    if (!matrix.allFinite()) continue;
    matrices[i] = covariance_of(Numbers({size, size}, numbers->data() + i * size * size), size, what);
  }
  return matrices;
}

std::string score(const std::string& name, const Numbers& truth, const Numbers& trajectory,
                  const std::optional<Numbers>& pose_covariances, const py::object& true_ids,
                  const Numbers& true_landmarks, const py::object& ids, const Numbers& map,
                  const std::optional<Numbers>& landmark_covariances, double rpe_interval) {
  harness::ForeignEstimates estimates;
  estimates.name = name;
  estimates.truth = harness::truth_from(poses_of(truth, "truth"));
  const std::vector<harness::TimedPose> poses = poses_of(trajectory, "trajectory");
  const auto of_poses = matrices_of<3>(pose_covariances, poses.size(), "the covariances of the poses");
  for (std::size_t i = 0; i < poses.size(); ++i) estimates.poses.push_back({poses[i], of_poses[i]});

  const seif::LandmarkIds known = ids_of(true_ids);
  const Eigen::MatrixXd places =
      matrix_of(true_landmarks, static_cast<Eigen::Index>(known.size()), 2, "landmarks");
  for (std::size_t i = 0; i < known.size(); ++i)
    estimates.landmarks.push_back({known[i], places.row(static_cast<Eigen::Index>(i)).transpose(), 0.0});
  std::ranges::sort(estimates.landmarks, {}, &harness::TrueLandmark::landmark);

  const seif::LandmarkIds mapped = ids_of(ids);
  const Eigen::MatrixXd means = matrix_of(map, static_cast<Eigen::Index>(mapped.size()), 2, "map");
  const auto of_map = matrices_of<2>(landmark_covariances, mapped.size(), "the covariances of the landmarks");
  for (std::size_t i = 0; i < mapped.size(); ++i)
    estimates.map.push_back({mapped[i], means.row(static_cast<Eigen::Index>(i)).transpose(), of_map[i]});
  return harness::to_json(harness::score_foreign(estimates, rpe_interval));
}

}  // namespace

void bind_scores(py::module_& module) {
  using namespace py::literals;
  module.def("score", &score, "name"_a, "truth"_a, "trajectory"_a, "pose_covariances"_a, "true_ids"_a,
             "true_landmarks"_a, "ids"_a, "map"_a, "landmark_covariances"_a, "rpe_interval"_a);
}

}  // namespace seifbed
