// Name and options of the estimator `mrpt_ekf`. The program knows them without the plug-in.
#pragma once

#include <string>
#include <utility>

#include "seif/registry.hpp"

namespace peers {

template <class Make>
seif::EstimatorType mrpt_ekf_type(Make make) {
  return {
      .name = "mrpt_ekf",
      .help =
          "MRPT's EKF-SLAM (CRangeBearingKFSLAM2D), a peer that is not ours; where this program was built "
          "with MRPT (SEIFBED_PEERS=1 ./seifbed).",
      .options = {{.key = "method",
                   .fallback = std::string("naive"),
                   .choices = {"naive", "davison"},
                   .help = "MRPT's kfEKFNaive, which is its default, or kfEKFAlaDavison, one scalar of a "
                           "scan at once."}},
      .make = std::move(make)};
}

}  // namespace peers
