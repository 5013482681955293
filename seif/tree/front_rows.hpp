// Where the variables of a front have their rows, and where the rows of its parts go.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "seif/chunked_array.hpp"
#include "seif/tree/condensed.hpp"

namespace seif {

class FrontRows {
 public:
  /// What a row of a part adds to: rows of the front, each with a weight.
  struct Term {
    int row;
    double weight;
  };

  /// Forgets all variables.
  void begin() { ++front_; }
  /// The number of a variable among those of the front; `next` if it is new.
  int index_of(FrontVariable v, int next);
  /// From now on variables have rows: those of E, then those of B; the tied ones have terms.
  void give(const Condensed& front);
  int row_of(FrontVariable v) { return of(v).row; }
  /// Rows of E and B. [-]
  int size() const { return size_; }

  /// Lists the rows of a part.
  void list(const Condensed& part);
  /// Of those listed last:
  std::size_t listed() const { return first_.size() - 1; }
  std::span<const Term> terms(std::size_t row) const {
    return std::span(terms_).subspan(first_[row], first_[row + 1] - first_[row]);
  }
  /// Whether any of them belongs to a tied variable.
  bool any_tied() const { return terms_.size() != listed(); }
  std::size_t memory_bytes() const { return landmarks_.memory_bytes() + groups_.memory_bytes(); }

 private:
  struct Rows {
    int front = 0;            // number of the front in which it was last
    int index = 0;            // among its variables, until it has a row
    int row = 0;              // of its group, if it is tied
    const Lever* lever = {};  // if it is tied
  };

  Rows& of(FrontVariable v);
  void add_row(std::span<const Term> terms);
  void add_untied(FrontVariable v, int row);
  void add_tied(FrontVariable v, const Rows& p);

  int front_ = 0;
  int size_ = 0;
  ChunkedArray<Rows> landmarks_, groups_;
  std::vector<Term> terms_;
  std::vector<std::size_t> first_;  // by row of the part: among terms_; and the end
};

}  // namespace seif
