// Scratch arrays that grow now and then, so that the steady state allocates nothing.
#pragma once

#include <Eigen/Core>

namespace seif {

/// At least n entries; what was in them is lost where they grow. A quarter of room is left.
inline void make_room(Eigen::VectorXd& array, Eigen::Index n) {
  if (array.size() < n) array.resize(n + n / 4);
}

}  // namespace seif
