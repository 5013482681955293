// The dense matrix of any filter of the library, as a reference for the filter's own answers.
#pragma once

#include "dense_oracle.hpp"
#include "seif/dense/eif.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/eseif.hpp"
#include "seif/full_state.hpp"
#include "seif/plain_seif.hpp"
#include "seif/seif.hpp"

namespace seif::test {

/// The whole matrix that a filter keeps: Sigma of an `ekf`, Omega of any other.
inline Eigen::MatrixXd matrix_of(const Estimator& filter) {
  if (const auto* seif = dynamic_cast<const Seif*>(&filter))
    return oracle::symmetric(full_Omega(seif->state()));
  if (const auto* report = dynamic_cast<const PlainSeif*>(&filter)) {
    return oracle::symmetric(full_Omega(report->state()));
  }
  if (const auto* eseif = dynamic_cast<const Eseif*>(&filter)) {
    return oracle::symmetric(full_Omega(eseif->state()));
  }
  if (const auto* eif = dynamic_cast<const Eif*>(&filter)) return eif->Omega();
  return dynamic_cast<const Ekf&>(filter).Sigma();
}

}  // namespace seif::test
