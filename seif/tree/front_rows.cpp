#include "seif/tree/front_rows.hpp"

#include <array>

namespace seif {

FrontRows::Rows& FrontRows::of(FrontVariable v) {
  ChunkedArray<Rows>& rows = is_group(v) ? groups_ : landmarks_;
  const auto i = static_cast<std::size_t>(is_group(v) ? ~v : v);
  while (rows.size() <= i) rows.push_back({});
  return rows[i];
}

int FrontRows::index_of(FrontVariable v, int next) {
  Rows& p = of(v);
  if (p.front != front_) {
    p.front = front_;
    p.index = next;
  }
  return p.index;
}

void FrontRows::give(const Condensed& front) {
  int row = 0;
  const auto give_row = [&](FrontVariable v) {
    of(v) = {.front = front_, .index = 0, .row = row, .lever = nullptr};
    row += freedom(v);
  };
  for (const FrontVariable v : front.eliminated) give_row(v);
  for (const Condensed::Member& m : front.boundary) give_row(m.variable);
  for (const Condensed::Tie& tie : front.tied)
    of(tie.variable) = {.front = front_, .index = 0, .row = tie.row, .lever = &tie.lever};
  size_ = row;
}

void FrontRows::list(const Condensed& part) {
  terms_.clear();
  first_.assign(1, 0);
  for (const Condensed::Member& m : part.boundary) {
    const Rows& p = of(m.variable);
    if (p.lever == nullptr) {
      add_untied(m.variable, p.row);
    } else {
      add_tied(m.variable, p);
    }
  }
}

void FrontRows::add_row(std::span<const Term> terms) {
  terms_.insert(terms_.end(), terms.begin(), terms.end());
  first_.push_back(terms_.size());
}

void FrontRows::add_untied(FrontVariable v, int row) {
  for (int k = 0; k < freedom(v); ++k) {
    terms_.push_back({row + k, 1.0});
    first_.push_back(terms_.size());
  }
}

/// By the rows [x, y, phi, dilation] of its group.
void FrontRows::add_tied(FrontVariable v, const Rows& p) {
  const Lever& lever = *p.lever;
  const Eigen::Vector2d tangent(-lever.y(), lever.x());
  for (int k = 0; k < 2; ++k)
    add_row(std::array<Term, 3>{{{p.row + k, 1.0}, {p.row + 2, tangent(k)}, {p.row + 3, lever(k)}}});
  if (!is_group(v)) return;
  for (int k = 2; k < 4; ++k) add_row(std::array<Term, 1>{{{p.row + k, 1.0}}});
}

}  // namespace seif
