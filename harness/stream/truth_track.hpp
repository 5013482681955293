// The truth between two recorded poses.
#pragma once

#include <limits>
#include <optional>

#include "harness/stream/stream.hpp"

namespace harness {

/// Interpolates linearly between two rows. The heading turns the shorter way.
TruePose interpolate(const TruePose& from, const TruePose& to, double t);

/// Gives the truth at any time; calls must come in the order of time. The truth is that of a row, or is
/// interpolated between two rows. Memory for two rows.
class TruthTrack {
 public:
  /// Between rows that are more than `longest_gap` [s] apart the truth is not known.
  explicit TruthTrack(double longest_gap = std::numeric_limits<double>::infinity())
      : longest_gap_(longest_gap) {}

  /// The truth at time `t` [s]; empty before the first row, after the last row, and in gaps. `next_row` gives
  /// the rows in the order of time, and nothing when there are no more.
  template <class NextRow>
  std::optional<TruePose> at(double t, const NextRow& next_row) {
    while (!ended_ && (!after_ || after_->t < t)) {
      before_ = after_;
      after_ = next_row();
      ended_ = !after_;
    }
    return between(t);
  }

 private:
  std::optional<TruePose> between(double t) const {
    if (after_ && after_->t == t) return after_;
    if (before_ && before_->t == t) return before_;
    if (!before_ || !after_ || t < before_->t || after_->t - before_->t > longest_gap_) return std::nullopt;
    return interpolate(*before_, *after_, t);
  }

  double longest_gap_;
  std::optional<TruePose> before_;
  std::optional<TruePose> after_;  // empty: no row was read yet, or the rows have ended
  bool ended_ = false;
};

}  // namespace harness
