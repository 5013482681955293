// Which landmarks are tied together to rigid groups, where a front would be too large.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "seif/tree/condensation_tree.hpp"

namespace seif {

int CondensationTree::node_of(FrontVariable v) const { return is_group(v) ? ~v : landmark(v).leaf; }

/// How far a group is from the next hot leaves, over its size.
double CondensationTree::distance_ratio(int group) {
  Node& n = node(group);
  if (n.distance_known_in == plan_.number) return n.distance_ratio;
  const LeafTree::Box& box = tree_.box(group);
  double squared = std::numeric_limits<double>::infinity();
  for (const int leaf : plan_.hot_leaves)
    squared = std::min(squared, box.squaredExteriorDistance(tree_.box(leaf)));
  const double size = box.diagonal().norm();
  n.distance_known_in = plan_.number;
  n.distance_ratio = squared > 0.0 ? std::sqrt(squared) / size : 0.0;
  return n.distance_ratio;
}

/// The node of the largest group that a variable of the front may be tied to, or none. Where a part of the
/// front has it in a group already, it goes where that goes. Whether a group may be is the same for all that
/// stand below its node: a front has all of them in it, or none.
int CondensationTree::group_for(FrontVariable v, double ratio) {
  if (!is_group(v) && node(landmark(v).leaf).next_hot) return none;
  const bool may_be_tied = groups_allowed_ && ratio < std::numeric_limits<double>::infinity();
  int chosen = none;
  for (int n = node_of(v); n != none; n = tree_.parent(n)) {
    const LandmarkGroup& group = node(n).group;
    const bool is_present = group.present_in == fronts_;
    const bool is_far = may_be_tied && distance_ratio(n) >= ratio;
    // A leaf may be wider than the rectangles above it, and nearer.
    if (!is_far && !any_present_ && !tree_.is_leaf(n)) break;
    if (is_present || (is_far && (group.fronts == 0 || group.known_in == plan_.number))) chosen = n;
  }
  return chosen;
}

/// Unknowns of the front if what is farther than `ratio` times its size is tied. Fills targets_.
int CondensationTree::count_unknowns(double ratio) {
  ++counts_;
  targets_.clear();
  for (const Front::Variable& v : front_.variables()) {
    const int target = group_for(v.variable, ratio);
    targets_.push_back(target);
    if (target == none) continue;
    LandmarkGroup& group = node(target).group;
    if (group.wanted_by != counts_) group.members = 0;
    group.wanted_by = counts_;
    ++group.members;
  }
  int unknowns = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    int& target = targets_[i];
    const FrontVariable v = front_.variables()[i].variable;
    if (target != none) {
      LandmarkGroup& group = node(target).group;
      const bool is_alone = group.members == 1 && group.present_in != fronts_;
      if (is_alone || v == group_variable(target)) target = none;
    }
    if (target == none) {
      unknowns += freedom(v);
    } else if (LandmarkGroup& group = node(target).group; group.wanted_by == counts_) {
      if (group.present_in != fronts_) unknowns += 3;
      group.wanted_by = 0;
    }
  }
  return unknowns;
}

/// From the finest groups that suffice to the coarsest that are allowed.
void CondensationTree::tie_front(int at, SentMessage& next) {
  ++fronts_;
  std::vector<int>& groups = next.groups;
  groups.clear();
  any_present_ = false;
  int unknowns = 0;
  for (const Front::Variable& v : front_.variables()) {
    unknowns += freedom(v.variable);
    if (!is_group(v.variable)) continue;
    any_present_ = true;
    node(~v.variable).group.present_in = fronts_;
    groups.push_back(~v.variable);
  }
  if (any_present_ || unknowns > options_.most_unknowns) {
    constexpr std::array<double, 5> ratios{std::numeric_limits<double>::infinity(), 8.0, 4.0, 2.0, 1.0};
    for (const double ratio : ratios) {
      if (count_unknowns(ratio * options_.grain) <= options_.most_unknowns) break;
    }
    const std::size_t count = targets_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (targets_[i] != none) tie(i, targets_[i], groups);
    }
  }
  note_reach(at, next);
}

/// In the middle of the variables that will be tied to it.
void CondensationTree::begin_group(int target) {
  LandmarkGroup& group = node(target).group;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  int members = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i] != target) continue;
    middle += plan_place(front_.variables()[i].variable);
    ++members;
  }
  group.start = group.place = middle / members;
  group.place_turn = 0.0;
  group.mean.setZero();
  group.read.setZero();
  group.known_in = plan_.number;
  plan_.begun.push_back(target);
}

void CondensationTree::tie(std::size_t index, int target, std::vector<int>& groups) {
  LandmarkGroup& group = node(target).group;
  if (group.present_in != fronts_) {
    group.present_in = fronts_;
    groups.push_back(target);
    if (group.fronts == 0 && group.known_in != plan_.number) begin_group(target);
  }
  const FrontVariable v = front_.variables()[index].variable;
  front_.tie(index, group_variable(target), plan_place(v) - plan_place(group_variable(target)));
}

void CondensationTree::note_reach(int at, SentMessage& next) {
  next.reach.setEmpty();
  for (const int g : next.groups) {
    ++node(g).group.fronts;
    const LeafTree::Box& box = tree_.box(g);
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.5 * options_.grain * box.diagonal().norm());
    next.reach.extend(LeafTree::Box(box.min() - margin, box.max() + margin));
  }
  tree_.for_each_planned_source(at, [&](int source) { next.reach.extend(next_of(source).reach); });
}

}  // namespace seif
