// The part of the information form outside the window: all landmarks, and the links between them.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "seif/chunked_array.hpp"
#include "seif/types.hpp"

namespace seif {

/// A graph of 2 x 2 blocks. Each block is stored once, and is an element of the linked lists of both its
/// landmarks.
class InformationGraph {
 public:
  using Block = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;
  using Point = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  static constexpr int none = -1;

  /// While a landmark is active, its mean, residual and information are kept in the window, and the copies here
  /// are out of date.
  struct Landmark {
    LandmarkId id = no_landmark;
    int position = none;       // its position in the window; none: passive
    int first_link = none;     // head of its list of links
    int last_seen = 0;         // number of the latest scan that saw it
    int sightings = 0;         // [-] scans that saw it
    Point mu = Point::Zero();  // p_world_landmark [m]
    Point r = Point::Zero();   // residual
    Block Omega_ii = Block::Zero();
    double squared_residual = 0.0;  // [-] r' Omega_ii^-1 r if tracked
  };

  Landmark& landmark(int slot) { return landmarks_[index(slot)]; }
  const Landmark& landmark(int slot) const { return landmarks_[index(slot)]; }
  int landmark_count() const { return static_cast<int>(landmarks_.size()); }
  int link_count() const { return static_cast<int>(links_.size()); }

  void add_landmark(LandmarkId id, const Eigen::Vector2d& mean) {
    landmarks_.push_back({.id = id, .mu = mean});
  }

  /// Returns the number of the new link.
  int add_link(int slot_i, int slot_j, const Block& Omega_ij) {
    const int link = link_count();
    Landmark& i = landmark(slot_i);
    Landmark& j = landmark(slot_j);
    links_.push_back({.end = {slot_i, slot_j}, .next = {i.first_link, j.first_link}, .Omega_ij = Omega_ij});
    i.first_link = link;
    j.first_link = link;
    return link;
  }

  /// Sets the block Omega_ij of a link, seen from `slot_i`, which is one of its two ends.
  void set_block(int link, int slot_i, const Block& Omega_ij) {
    Link& l = links_[index(link)];
    if (l.end[0] == slot_i) {
      l.Omega_ij = Omega_ij;
    } else {
      l.Omega_ij = Omega_ij.transpose();
    }
  }

  /// Calls visit(link, end, other) for each link of a landmark. The landmark is end number `end` of the link (0
  /// or 1); `other` is the slot at the other end.
  template <class Visit>
  void for_each_link(int slot, Visit&& visit) const {
    for (int link = landmark(slot).first_link; link != none;) {
      const Link& l = links_[index(link)];
      const int end = l.end[0] == slot ? 0 : 1;
      const int next = l.next[end];
      visit(link, end, l.end[1 - end]);
      link = next;
    }
  }

  /// Omega_ij with i the first end of the link. The second end sees the transpose of it.
  const Block& stored_block(int link) const { return links_[index(link)].Omega_ij; }
  Block block(int link, int end) const {
    return end == 0 ? stored_block(link) : Block(stored_block(link).transpose());
  }

  std::size_t memory_bytes() const { return landmarks_.memory_bytes() + links_.memory_bytes(); }

 private:
  /// While both ends are active, the block is kept in the window, and this copy is out of date.
  struct Link {
    int end[2] = {none, none};   // slots i, j
    int next[2] = {none, none};  // the next link in the list of i, and of j
    Block Omega_ij = Block::Zero();
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  ChunkedArray<Landmark> landmarks_;  // by slot
  ChunkedArray<Link> links_;
};

}  // namespace seif
