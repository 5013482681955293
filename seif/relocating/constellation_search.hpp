// Looks for what lies around the robot in a map whose landmarks have no names.
//
//   a triangle around the robot -> triangles of the map with the same sides -> a pose for each
//     -> how many of the other landmarks are there, too? -> the best few poses, which are grown and compared
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seif/association/constellation_index.hpp"
#include "seif/association/landmark_grid.hpp"
#include "seif/relocating/placement.hpp"
#include "seif/types.hpp"

namespace seif {

/// Poses of a local map in the map, from one scan to the next. The local map has a frame of its own.
class ConstellationSearch {
 public:
  /// `near`: how near to a landmark something must be to be taken for it, before covariances are known [m].
  ConstellationSearch(const LandmarkGrid& grid, const ConstellationIndex& index, double near)
      : grid_(grid), index_(index), near_(near) {}

  struct Points {
    std::vector<Eigen::Vector2d> p_local = {};  // [m]
    /// Of points that are in the map themselves, in whose frame they are then: what they are not to be taken for.
    std::vector<LandmarkId> own = {};
    double farthest = 0.0;  // [m] from there, for these; farther away nothing is looked for
  };
  /// The points of the local map that are around the robot now, the nearest first. `T_world_robot`: what the filter
  /// believes. The nearer to that, the fewer other places have to be excluded.
  void set_points(const Points& points, const Pose2& T_local_robot, const Pose2& T_world_robot);

  /// After so many triangles of the map, or poses that they give, a look ends.
  struct Limits {
    std::int64_t triangles, poses;  // [-]
  };
  /// Looks up the triangles of a point with the points near it.
  void look_from(std::size_t corner, const Limits& limits);
  /// Those of one point after the other, going on with each call, until enough triangles have been looked at.
  void look_around();

  /// Takes into account that the local map may lie there.
  void consider(const Pose2& T_world_local) { try_pose(climb(T_world_local)); }

  struct Found {
    Pose2 T_world_local;
    std::vector<Pairing> pairs;  // of the points
    double density = 0.0;        // of landmarks around there [1/m^2]
    /// [nat] How many places of 1 m^2, times turns of 1 rad, are no farther from the belief.
    double log_places = 0.0;
  };
  /// The best pose so far, if no other one is nearly as good, and enough has been looked at.
  std::optional<Found> best() const;
  /// Whether the surroundings look the same as other parts of the map: two poses fit to more than half of what fits best.
  bool is_ambiguous() const;

  /// [-] Triangles of the map looked at so far.
  std::int64_t work() const { return work_; }

 private:
  struct Hypothesis {
    Pose2 T_world_local;
    std::size_t fitting = 0;  // [-] points with a landmark
    double score = 0.0;       // [nat] how much better it is than chance
  };

  void try_triangle(const Triangle& triangle);
  void try_pose(const Pose2& T_world_local);
  std::size_t count(const Pose2& T_world_local, std::size_t at_least) const;
  void remember(const Hypothesis& hypothesis);
  bool is_alike(const Pose2& a, const Pose2& b) const;
  void pair(const Pose2& T_world_local, std::vector<Pairing>& pairs) const;
  Pose2 climb(Pose2 T_world_local, std::vector<Pairing>& pairs) const;
  Pose2 climb(const Pose2& T_world_local) const {
    std::vector<Pairing> pairs;
    return climb(T_world_local, pairs);
  }
  Hypothesis rated(const Pose2& T_world_local, std::size_t fitting) const;
  bool may_be(const Triangle& triangle, const std::array<LandmarkId, 3>& corners) const;
  bool fits_nearby(const Pose2& T_world_local) const;
  void find_near(std::size_t point, const Pose2& T_world_local, std::size_t most) const;
  double density_at(const Pose2& T_world_local) const;
  double log_places(const Pose2& T_world_local, double density) const;
  bool is_complete(const Found& found) const;
  bool is_alone() const;
  bool is_of_map() const { return !around_.own.empty(); }
  bool is_own(std::size_t point, LandmarkId landmark) const {
    return is_of_map() && around_.own[point] == landmark;
  }

  const LandmarkGrid& grid_;
  const ConstellationIndex& index_;
  double near_;
  Points around_;
  Pose2 T_local_robot_, T_world_robot_;
  double radius_ = 0.0;                 // of the points around the robot [m]
  double density_ = 0.0;                // of them [1/m^2]
  std::vector<Hypothesis> hypotheses_;  // the best, different ones, the best first
  std::size_t next_corner_ = 0, corners_done_ = 0;
  std::int64_t work_ = 0, poses_ = 0;  // [-] triangles of the map, and poses that they gave
  Limits until_ = {0, 0};
  mutable std::vector<LandmarkGrid::Near> found_near_;
};

}  // namespace seif
