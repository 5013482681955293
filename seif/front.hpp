// Elimination of landmarks from a part of the information matrix: what nodes of the condensation tree do.
//
//   a part of Omega       eliminated E   boundary B
//   (a front)         E [ M_EE                      ]       M_EE = L L',  G = L^-1 M_EB
//                     B [ M_BE           M_BB       ]       condensed: S = M_BB - G' G
//
// E must have all its blocks in this front. Where the mean of B goes by d_B, that of E goes by -L^-T G d_B.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "seif/chunked_array.hpp"

namespace seif {

/// What a front leaves behind. Landmarks go by their slots.
struct Condensed {
  /// A landmark of the boundary.
  struct Mention {
    int slot;
    int leaves;  // [-] of those condensed here, how many mention it
  };
  std::vector<Mention> boundary;  // b / 2
  std::vector<int> eliminated;    // e / 2
  std::vector<double> factor;     // (e + b x e) [L; G'], by column
  std::vector<double> S;          // (b x b) lower triangle, by column
  std::vector<double> reference;  // (b) the mean of the boundary for which that of E holds [m]

  auto L_and_G() const {
    const auto e = 2 * static_cast<Eigen::Index>(eliminated.size());
    const auto b = 2 * static_cast<Eigen::Index>(boundary.size());
    return Eigen::Map<const Eigen::MatrixXd>(factor.data(), e + b, e);
  }
  /// The distinct blocks of it.
  std::int64_t blocks() const {
    const auto n = static_cast<std::int64_t>(eliminated.size() + boundary.size());
    return n * (n + 1) / 2;
  }
  void clear();
  std::size_t memory_bytes() const;
};

class Front {
 public:
  /// A landmark has joined the map: slots come in order.
  void add_landmark() { places_.push_back({}); }

  void begin();
  /// The front takes in what another has left.
  void add(const Condensed& part);
  /// A leaf has blocks of this landmark.
  void mention(int slot) { entries_[entry_of(slot)].leaves += 1; }
  /// Omega_ij; both must be mentioned. For i == j the lower triangle counts.
  void add(int slot_i, int slot_j, const Eigen::Matrix2d& Omega_ij);

  /// Eliminates all landmarks of which is_complete(slot, leaves that mention it here) holds. False if their
  /// block is not positive definite. `out` may not be one that was added.
  template <class IsComplete>
  [[nodiscard]] bool condense(IsComplete&& is_complete, Condensed& out) {
    out.clear();
    for (const Entry& entry : entries_) {
      if (is_complete(entry.slot, entry.leaves)) {
        out.eliminated.push_back(entry.slot);
      } else {
        out.boundary.push_back({entry.slot, entry.leaves});
      }
    }
    return factorise(out);
  }

  /// The landmarks in it. [-]
  int size() const { return static_cast<int>(entries_.size()); }
  std::size_t memory_bytes() const;

 private:
  struct Entry {
    int slot;
    int leaves;
    int row;
  };
  struct Place {
    int front = 0;  // number of the front in which it was last
    int entry = 0;
  };
  struct Block {
    std::size_t entry_i, entry_j;
    Eigen::Matrix<double, 2, 2, Eigen::DontAlign> Omega_ij;
  };

  std::size_t entry_of(int slot);
  int row_of(int slot) const;
  void assemble(const Condensed& out, Eigen::Index size);
  bool factorise(Condensed& out);

  int front_ = 0;
  ChunkedArray<Place> places_;
  std::vector<Entry> entries_;
  std::vector<Block> blocks_;
  std::vector<const Condensed*> parts_;
  std::vector<int> rows_;  // of the boundary of one part
  Eigen::MatrixXd M_;      // lower triangle, with room to grow
};

}  // namespace seif
