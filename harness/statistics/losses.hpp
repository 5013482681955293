// Counts how often a filter lost its place and found it again, from the counts of its updates.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace harness {

/// What one update says of it.
struct UpdateOfLoss {
  double t = 0.0;                // [s]
  bool has_used = false;         // whether the filter took in an observation of a known landmark
  std::int64_t left_out = 0;     // [-] observations of this scan that it did not
  std::int64_t relocations = 0;  // [-] in this update
  std::optional<double> distance =
      {};  // [-] e' P^-1 e of the pose; empty if truth or covariance is not known
};

/// e' P^-1 e of an error [x y theta] of covariance P. Nothing if P is not positive definite. [-]
std::optional<double> squared_distance(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance);

/// A filter is lost if it leaves out all that two scans in a row see; a single one may be an outlier. It is found when
/// it relocates: wrongly, if the pose is then farther from the truth than that of a consistent filter would be with
/// probability 1e-6. Constant time and memory.
class Losses {
 public:
  void add(const UpdateOfLoss& update);

  bool is_lost() const { return scans_ >= fewest_scans; }
  int count() const { return count_; }
  int found() const { return found_; }
  int found_wrongly() const { return wrong_; }
  double lost_s() const { return lost_s_; }                               // [s] in all
  std::optional<double> found_t() const { return found_t_; }              // [s] the last time
  std::optional<double> first_found_t() const { return first_found_t_; }  // [s]

 private:
  static constexpr int fewest_scans = 2;  // [-]

  void note_found(const UpdateOfLoss& update);

  int scans_ = 0;        // [-] left out, in a row
  double before_ = 0.0;  // [s] the first of them, or the last time while lost
  int count_ = 0, found_ = 0, wrong_ = 0;
  double lost_s_ = 0.0;
  std::optional<double> found_t_, first_found_t_;
};

}  // namespace harness
