// MRPT's range-bearing EKF-SLAM: a filter of another project, for comparison. It is in a plug-in, which is loaded
// when the estimator is made: MRPT's libraries take long to load, and need not be there.
#pragma once

#include <filesystem>

#include "seif/registry.hpp"

namespace harness {

/// The path of the plug-in with MRPT: in the installed copy that the program belongs to, or where the build puts it.
std::filesystem::path peers_module();

/// The estimator type `mrpt_ekf`. Making the estimator throws BadInput if the plug-in does not exist.
seif::EstimatorType mrpt_ekf_estimator(const std::filesystem::path& module = peers_module());

}  // namespace harness
