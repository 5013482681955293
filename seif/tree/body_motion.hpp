// How a part of the map has moved as a whole: the rigid motion that takes its boundary from where it was to where it
// is now.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace seif {

/// p = now + R (p_before - before).
struct BodyMotion {
  Eigen::Vector2d before = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d now = Eigen::Vector2d::Zero();     // [m]
  double angle = 0.0;                                // [rad]
  Eigen::Matrix2d R = Eigen::Matrix2d::Identity();   // by angle

  bool is_identity() const { return angle == 0.0; }
  Eigen::Vector2d moved(const Eigen::Vector2d& p) const { return now + R * (p - before); }
  /// The step of a point in the body's own frame, from where it was.
  Eigen::Vector2d step(const Eigen::Vector2d& p_before, const Eigen::Vector2d& p_now) const {
    return R.transpose() * (p_now - now) - (p_before - before);
  }
};

/// Collects points before and after, and finds the rigid motion of the whole. Points that are near each other, before
/// and after, and at the same distance, form a cluster with a rigid motion of its own. A body may be soft between
/// clusters, as between the two ends of a ring that closes.
class BodyFit {
 public:
  struct Point {
    Eigen::Vector2d before, now;
    int cluster;  // or none
  };
  /// Of levers before and now.
  struct Turn {
    double dot = 0.0, cross = 0.0;  // sums [m^2]
    void add(const Eigen::Vector2d& before, const Eigen::Vector2d& now, double weight = 1.0);
    bool is_known() const { return dot != 0.0 || cross != 0.0; }
  };
  struct Cluster {
    int points = 0;
    Turn turn;
    BodyMotion motion;
  };
  static constexpr int none = -1;
  static constexpr double weight_of_turn = 100.0;  // [m^2] of a point whose turn is known

  /// `near`: the distance up to which two points are near each other [m].
  void begin(double near);
  void add(const Eigen::Vector2d& p_before, const Eigen::Vector2d& p_now);
  /// A point that belongs to no cluster, and whose turn is known.
  void add_turned(const Eigen::Vector2d& p_before, const Eigen::Vector2d& p_now, double angle);

  /// Finds all motions. That of the whole has the mean turn of clusters and turned points. Without any it has the turn
  /// that fits the points best; the identity for a single point, or none.
  const BodyMotion& fit();

  const BodyMotion& motion() const { return motion_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Cluster>& clusters() const { return clusters_; }
  /// Whether the turn of the whole comes from clusters and turned points.
  bool is_by_clusters() const { return by_clusters_; }
  /// The cluster of a point, if its turn is known. None if all points are in one: that is the body.
  const Cluster* cluster_of(const Point& point) const;
  /// The step of a point in the frame of the body. What its cluster has turned against the body counts along the
  /// tangent, as the linear equations have it.
  Eigen::Vector2d step(std::size_t i) const;

 private:
  bool are_together(const Point& point, const Eigen::Vector2d& p_before, const Eigen::Vector2d& p_now) const;
  void join(int from, int to);
  void find_middles();
  void find_turns();

  double squared_near_ = 0.0;  // [m^2]
  std::vector<Point> points_;
  std::vector<Cluster> clusters_;
  Turn known_;  // of turned points
  bool by_clusters_ = false;
  BodyMotion motion_;
};

}  // namespace seif
