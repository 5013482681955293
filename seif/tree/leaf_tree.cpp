#include "seif/tree/leaf_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace seif {
namespace {

constexpr int most_branches = 4;  // [-] that are begun in one rectangle
constexpr double cell = 4.0;      // [m] finer places are not told apart
constexpr double turn =
    0.46;  // [rad] of the grid: corridors that run along its lines would change sides often

std::uint64_t spread_bits(std::uint64_t x) {  // 16 of them, to every second place
  x = (x | x << 8) & 0x00FF00FF;
  x = (x | x << 4) & 0x0F0F0F0F;
  x = (x | x << 2) & 0x33333333;
  return (x | x << 1) & 0x55555555;
}

constexpr double half = 32768.0;  // [-] cells on either side of the origin

std::uint64_t cell_of(double coordinate) {
  return static_cast<std::uint64_t>(std::clamp(coordinate / cell + half, 0.0, 2.0 * half - 1.0));
}

/// The cell of a place of the grid, by both coordinates' bits in turns, and then what tells it from others
/// there.
std::uint64_t key_of(const Eigen::Vector2d& p, int leaf) {
  return (spread_bits(cell_of(p.x())) << 1 | spread_bits(cell_of(p.y()))) << 32 |
         static_cast<std::uint64_t>(leaf);
}

std::uint64_t gather_bits(std::uint64_t x) {  // what spread_bits() has spread
  x &= 0x55555555;
  x = (x | x >> 1) & 0x33333333;
  x = (x | x >> 2) & 0x0F0F0F0F;
  x = (x | x >> 4) & 0x00FF00FF;
  return (x | x >> 8) & 0x0000FFFF;
}

/// The rectangle of all places whose keys differ from this one in no bit above `bit`.
LeafTree::Box rectangle_of(std::uint64_t key, int bit) {
  const int free = std::max(bit - 31, 0);  // of the place's bits, the last of y first
  const auto side = [](std::uint64_t bits, int free_bits) -> Eigen::Vector2d {
    const double from = static_cast<double>(gather_bits(bits) >> free_bits << free_bits) - half;
    return Eigen::Vector2d(from, from + static_cast<double>(1U << static_cast<unsigned>(free_bits))) * cell;
  };
  const Eigen::Vector2d x = side(key >> 33, free / 2);
  const Eigen::Vector2d y = side(key >> 32, (free + 1) / 2);
  return {Eigen::Vector2d(x(0), y(0)), Eigen::Vector2d(x(1), y(1))};
}

}  // namespace

LeafTree::LeafTree(const Pose2& start) : T_world_grid_(start * Pose2{.theta = -turn}) {}

Eigen::Vector2d LeafTree::in_grid(const Eigen::Vector2d& p_world) const {
  return inverse(T_world_grid_) * p_world;
}

int LeafTree::add_node() {
  nodes_.push_back({});
  return size() - 1;
}

int LeafTree::new_leaf() { return add_node(); }

int LeafTree::attach(int leaf) {
  const std::uint64_t key = at(leaf).key = key_of(box(leaf).center(), leaf);
  at(leaf).leaves = 1;
  if (root_ == none) {
    root_ = leaf;
    return none;
  }
  int sibling = root_;
  const auto differ_at = [&] { return static_cast<int>(std::bit_width(at(sibling).key ^ key)) - 1; };
  const auto is_below = [&] {
    const int bit = differ_at();
    return bit < at(sibling).bit || (bit == at(sibling).bit && at(sibling).branches == most_branches);
  };
  while (is_below()) sibling = at(sibling).child[key >> at(sibling).bit & 1U];
  const int bit = differ_at();
  const int inner = insert_above(sibling);
  const std::size_t side = key >> bit & 1U;
  at(inner).key = key;
  at(inner).bit = bit;
  at(inner).branches = at(sibling).bit == bit ? at(sibling).branches + 1 : 1;
  at(inner).box = rectangle_of(key, bit);
  at(inner).child[side] = leaf;
  at(inner).child[1 - side] = sibling;
  at(leaf).parent = inner;
  at(inner).leaves = at(sibling).leaves;
  at(inner).cover = cover(sibling);
  cover_above(leaf, box(leaf));
  for (int n = inner; n != none; n = at(n).parent) ++at(n).leaves;
  return inner;
}

/// A new node between a node and its parent, or above the root.
int LeafTree::insert_above(int below) {
  const int inner = add_node();
  const int above = at(below).parent;
  at(inner).parent = above;
  at(below).parent = inner;
  if (above == none) {
    root_ = inner;
  } else {
    at(above).child[at(above).child[0] == below ? 0 : 1] = inner;
  }
  return inner;
}

bool LeafTree::is_within(int node, int ancestor) const {
  int n = node;
  while (n != ancestor && n != none && at(n).bit <= at(ancestor).bit) n = at(n).parent;
  return n == ancestor;
}

Eigen::Vector2d LeafTree::centre(int node) const {
  return T_world_grid_ * Eigen::Vector2d(box(node).center());
}

void LeafTree::widen(int leaf, const Eigen::Vector2d& p_world) {
  const Eigen::Vector2d p = in_grid(p_world);
  at(leaf).box.extend(p);
  cover_above(leaf, Box(p));
}

/// The nodes above a node cover this box, too.
void LeafTree::cover_above(int node, const Box& box) {
  for (int n = at(node).parent; n != none && !at(n).cover.contains(box); n = at(n).parent)
    at(n).cover.extend(box);
}

}  // namespace seif
