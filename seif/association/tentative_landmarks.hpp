// Positions at which something was seen that is not in the map. It becomes a landmark when it was seen often enough;
// before that it may be a false detection. The list is bounded, and what is not seen again soon is forgotten.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace seif {

class TentativeLandmarks {
 public:
  /// The result of a sighting: how often it was seen, and for how many scans.
  struct Sighting {
    int times = 0;  // [-] scans that saw it, this one too
    int age = 0;    // [-] scans since the first that did
  };

  /// Forgets what was not seen for `forget_after` scans.
  explicit TentativeLandmarks(int forget_after) : forget_after_(forget_after) {
    tentative_.reserve(most_tentative);
  }

  /// Begins the next scan. `wander`: variance that the robot's motion since the last scan adds. [m^2]
  void begin_scan(double wander);

  /// Something seen at p_world [m], known by itself to within `variance` [m^2]. Joins the nearest tentative landmark
  /// inside the gate that was not seen in this scan, or becomes a new one.
  Sighting see(const Eigen::Vector2d& p_world, double variance, double gate);

  /// The landmark seen last is in the map now.
  void admit_last() { tentative_.erase(tentative_.begin() + static_cast<std::ptrdiff_t>(last_)); }

  std::size_t size() const { return tentative_.size(); }
  std::size_t memory_bytes() const { return tentative_.capacity() * sizeof(Tentative); }

 private:
  static constexpr std::size_t most_tentative = 128;  // [-] beyond that the one longest not seen goes
  struct Tentative {
    Eigen::Matrix<double, 2, 1, Eigen::DontAlign> p_world;  // [m]
    double variance;                                        // [m^2]
    int times;                                              // [-]
    int first_scan, last_scan;
  };
  std::size_t room();

  int forget_after_;  // [-] scans
  int scan_ = 0;
  std::size_t last_ = 0;
  std::vector<Tentative> tentative_;
};

}  // namespace seif
