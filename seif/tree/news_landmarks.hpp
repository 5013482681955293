// The landmarks of which others have told, until they lie where the news were linearised.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "seif/tree/moved_boundary.hpp"

namespace seif {

class NewsLandmarks {
 public:
  bool is_empty() const { return landmarks_.empty(); }
  std::size_t size() const { return landmarks_.size(); }

  void add(int slot) {
    if (std::ranges::find(landmarks_, slot, &Landmark::slot) == landmarks_.end())
      landmarks_.push_back({.slot = slot, .linearised = Eigen::Vector2d::Zero()});
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Landmark& landmark : landmarks_) visit(landmark.slot);
  }

  /// The news are linearised where the landmarks are now: at mean_of(slot).
  template <class MeanOf>
  void linearise(MeanOf&& mean_of) {
    for (Landmark& landmark : landmarks_) landmark.linearised = mean_of(landmark.slot);
  }

  /// Whether landmarks have moved farther than `most` [m] against each other since. If not, and after some times at the
  /// latest, they are no news any more: of a landmark of which little is known the place may change each time.
  template <class MeanOf>
  bool must_repeat(const Turning& turning, double most, MeanOf&& mean_of) {
    constexpr int most_repeats = 5;  // [-]
    moved_.begin(turning);
    for (const Landmark& landmark : landmarks_)
      moved_.add({.before = landmark.linearised, .now = mean_of(landmark.slot)});
    moved_.fit();
    double longest = 0.0;
    for (std::size_t i = 0; i < size(); ++i) longest = std::max(longest, moved_.step(i).norm());
    if (longest > most && ++repeats_ <= most_repeats) return true;
    landmarks_.clear();
    repeats_ = 0;
    return false;
  }

 private:
  struct Landmark {
    int slot;
    Eigen::Vector2d linearised;  // p_world [m]
  };

  std::vector<Landmark> landmarks_;
  MovedBoundary moved_;
  int repeats_ = 0;  // [-]
};

}  // namespace seif
