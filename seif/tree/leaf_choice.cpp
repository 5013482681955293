#include "seif/tree/leaf_choice.hpp"

#include <limits>

namespace seif {

void LeafChoice::make_nodes() {
  while (static_cast<int>(records_.nodes.size()) < records_.tree.size()) records_.nodes.push_back({});
}

/// While a plan runs, it stands beside the tree.
int LeafChoice::new_leaf(const Eigen::Vector2d& home) {
  const int leaf = records_.tree.new_leaf();
  records_.tree.widen(leaf, home);
  if (plan_.is_running) {
    plan_.new_leaves.push_back(leaf);
  } else {
    attach(leaf);
  }
  make_nodes();
  return leaf;
}

/// An inner node that this adds passes on what comes to it.
void LeafChoice::attach(int leaf) {
  const int inner = records_.tree.attach(leaf);
  make_nodes();
  marking_.note_change(leaf);
  if (inner == none) return;
  const auto [a, b] = records_.tree.children(inner);
  const CondensationNode& sibling = records_.node(a == leaf ? b : a);
  if (!sibling.on_path) return;
  records_.node(inner).on_path = true;
  records_.node(inner).ring = sibling.ring;
  records_.path.push_back(inner);
}

bool LeafChoice::has_room(int leaf) const {
  return records_.node(leaf).landmarks < records_.options.most_in_leaf;
}

int LeafChoice::in_zone(const Eigen::Vector2d& p_world, const Eigen::Vector2d& home) {
  int nearest = none;
  double shortest = std::numeric_limits<double>::infinity();
  for (const int leaf : records_.hot_leaves) {
    if (!has_room(leaf) || !records_.node(leaf).next_hot) continue;
    const int first = records_.landmark(records_.node(leaf).first_landmark).zone_index;
    const double distance = (zone_.mean(first) - p_world).squaredNorm();
    if (distance >= shortest) continue;
    shortest = distance;
    nearest = leaf;
  }
  if (nearest != none) return nearest;
  const int leaf = new_leaf(home);
  CondensationNode& n = records_.node(leaf);
  n.hot = n.next_hot = true;
  n.used = choice_.scan();
  records_.hot_leaves.push_back(leaf);
  return leaf;
}

int LeafChoice::anywhere(const Eigen::Vector2d& home) {
  int nearest = none;
  double shortest = records_.view * records_.view;
  for (const int leaf : of_news_) {
    if (!has_room(leaf)) continue;
    const double distance = (records_.tree.centre(leaf) - home).squaredNorm();
    if (distance >= shortest) continue;
    shortest = distance;
    nearest = leaf;
  }
  if (nearest == none) of_news_.push_back(nearest = new_leaf(home));
  return nearest;
}

}  // namespace seif
