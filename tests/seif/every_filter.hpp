// The filters of the library by name, for tests that hold for all of them.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seif/registry.hpp"

namespace seif::test {

/// `seif` with the mean by groups. The library does not know this name.
inline const std::string seif_by_groups = "seif_by_groups";

/// All but `multi_seif`, which is a `seif` to the bit where it is alone (TeamFilter.AloneIsASeif).
inline std::vector<std::string> every_filter() {
  std::vector<std::string> names{seif_by_groups};
  const Registry registry = standard_estimators();
  for (const EstimatorType& type : registry.types()) {
    if (type.name != "multi_seif") names.push_back(type.name);
  }
  return names;
}

/// For INSTANTIATE_TEST_SUITE_P: names the test after the filter.
inline std::string name_of(const testing::TestParamInfo<std::string>& filter) { return filter.param; }

/// The filter itself, with its defaults, and without what looks for its place when it is lost. With `is_linear` it takes observations for as linear as the other filters do, with
/// `is_fixed` nothing that it has learnt turns later.
inline std::unique_ptr<Estimator> make(const std::string& name, const EstimatorSetup& setup,
                                       bool is_linear = false, bool is_fixed = false) {
  const Registry registry = standard_estimators();
  const EstimatorType* type = registry.find(name == seif_by_groups ? "seif" : name);
  Options options;
  for (const OptionSpec& spec : type->options) options[spec.key] = spec.fallback;
  if (name == seif_by_groups) options["mean_recovery"] = std::string("multilevel");
  if (options.contains("relocate")) options["relocate"] = std::string("never");
  if (is_linear && options.contains("linearisation_noise")) options["linearisation_noise"] = 0.0;
  if (is_fixed && options.contains("tree_frames")) options["tree_frames"] = std::string("fixed");
  return type->make(setup, options);
}

/// The marginals of the pose and of the whole map. Fails the test, and returns nothing, if the belief is not
/// a proper Gaussian: all finite, the covariances positive definite.
inline std::optional<MarginalCovariances> proper_belief(const Estimator& filter) {
  const Pose2 pose = filter.pose();
  EXPECT_TRUE(Eigen::Vector3d(pose.x, pose.y, pose.theta).allFinite());
  std::vector<LandmarkId> landmarks;
  for (const LandmarkEstimate& estimate : filter.map()) {
    EXPECT_TRUE(estimate.mean.allFinite()) << "landmark " << estimate.landmark;
    landmarks.push_back(estimate.landmark);
  }
  const std::optional<MarginalCovariances> marginals = filter.marginal_covariances(landmarks);
  EXPECT_TRUE(marginals.has_value());
  if (!marginals) return marginals;
  EXPECT_TRUE(marginals->pose.allFinite());
  EXPECT_EQ(marginals->pose.llt().info(), Eigen::Success);
  for (const Eigen::Matrix2d& covariance : marginals->landmarks) {
    EXPECT_TRUE(covariance.allFinite());
    EXPECT_EQ(covariance.llt().info(), Eigen::Success);
  }
  return marginals;
}

}  // namespace seif::test
