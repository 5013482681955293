#include "seif/tree/grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "seif/linearisation.hpp"

namespace seif {

/// How far a group is from the next hot leaves, over its size.
double Grouping::distance_ratio(int group) {
  CondensationNode& n = records_.node(group);
  if (n.distance_known_in == plan_.number) return n.distance_ratio;
  const LeafTree::Box& box = records_.tree.box(group);
  double squared = std::numeric_limits<double>::infinity();
  for (const int leaf : plan_.hot_leaves)
    squared = std::min(squared, box.squaredExteriorDistance(records_.tree.box(leaf)));
  const double size = box.diagonal().norm();
  n.distance_known_in = plan_.number;
  n.distance_ratio = squared > 0.0 ? std::sqrt(squared) / size : 0.0;
  return n.distance_ratio;
}

void Grouping::tie_front(const InformationState& state, SentMessage& next) {
  ++fronts_;
  next.groups.clear();
  const int unknowns = note_present(next.groups);
  if (!any_present_ && unknowns <= records_.options.most_unknowns) return;
  constexpr std::array<double, 5> ratios{std::numeric_limits<double>::infinity(), 8.0, 4.0, 2.0, 1.0};
  for (const double ratio : ratios) {
    if (count_unknowns(ratio * records_.options.grain) <= records_.options.most_unknowns) break;
  }
  const std::size_t count = targets_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (targets_[i] != none) tie(state, i, next.groups);
  }
}

/// Returns the number of unknowns without new ties.
int Grouping::note_present(std::vector<int>& groups) {
  any_present_ = false;
  int unknowns = 0;
  for (const Front::Variable& v : front_.variables()) {
    unknowns += freedom(v.variable);
    if (!is_group(v.variable)) continue;
    any_present_ = true;
    records_.node(~v.variable).group.present_in = fronts_;
    groups.push_back(~v.variable);
  }
  return unknowns;
}

/// The node of the largest group that a variable of the front may be tied to, or none. Where a part of the
/// front has it in a group already, it goes where that goes. Whether a group may be is the same for all that
/// stand below its node: a front has all of them in it, or none.
int Grouping::group_for(FrontVariable v, double ratio) {
  if (!is_group(v) && records_.node(records_.landmark(v).leaf).next_hot) return none;
  const bool may_be_tied = allowed_ && ratio < std::numeric_limits<double>::infinity();
  int chosen = none;
  for (int n = records_.node_of(v); n != none; n = records_.tree.parent(n)) {
    const LandmarkGroup& group = records_.node(n).group;
    const bool is_present = group.present_in == fronts_;
    const bool is_far = may_be_tied && distance_ratio(n) >= ratio;
    // A leaf may be wider than the rectangles above it, and nearer.
    if (!is_far && !any_present_ && !records_.tree.is_leaf(n)) break;
    if (is_present || (is_far && (group.fronts == 0 || group.known_in == plan_.number))) chosen = n;
  }
  return chosen;
}

/// What is farther than `ratio` times its size is tied.
void Grouping::list_targets(double ratio) {
  ++counts_;
  targets_.clear();
  for (const Front::Variable& v : front_.variables()) {
    const int target = group_for(v.variable, ratio);
    targets_.push_back(target);
    if (target == none) continue;
    LandmarkGroup& group = records_.node(target).group;
    if (group.wanted_by != counts_) group.unknowns = 0;
    group.wanted_by = counts_;
    group.unknowns += freedom(v.variable);
  }
}

/// Unknowns of the front. A group that has no fewer unknowns than its members would save nothing.
int Grouping::count_unknowns(double ratio) {
  list_targets(ratio);
  int unknowns = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    int& target = targets_[i];
    const FrontVariable v = front_.variables()[i].variable;
    if (target != none) {
      const LandmarkGroup& group = records_.node(target).group;
      const bool saves = group.unknowns > freedom(group_variable(target)) || group.present_in == fronts_;
      if (!saves || v == group_variable(target)) target = none;
    }
    if (target == none) {
      unknowns += freedom(v);
    } else if (LandmarkGroup& group = records_.node(target).group; group.wanted_by == counts_) {
      if (group.present_in != fronts_) unknowns += freedom(group_variable(target));
      group.wanted_by = 0;
    }
  }
  return unknowns;
}

/// Where the plan has it. What does not turn stays where its Jacobians were taken. [m]
Eigen::Vector2d Grouping::place(const InformationState& state, FrontVariable v) const {
  if (!is_group(v))
    return records_.options.turns ? Eigen::Vector2d(records_.landmark(v).planned)
                                  : linearisation_point(state, v);
  const LandmarkGroup& group = records_.node(~v).group;
  return records_.options.turns ? Eigen::Vector2d(group.start + group.planned.head<2>())
                                : Eigen::Vector2d(group.start);
}

/// In the middle of the variables that will be tied to it.
void Grouping::begin_group(const InformationState& state, int target) {
  LandmarkGroup& group = records_.node(target).group;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  int members = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (targets_[i] != target) continue;
    middle += place(state, front_.variables()[i].variable);
    ++members;
  }
  group.start = middle / members;
  group.mean.setZero();
  group.read.setZero();
  group.planned.setZero();
  group.known_in = plan_.number;
}

void Grouping::tie(const InformationState& state, std::size_t index, std::vector<int>& groups) {
  const int target = targets_[index];
  const FrontVariable g = group_variable(target);
  LandmarkGroup& group = records_.node(target).group;
  if (group.present_in != fronts_) {
    group.present_in = fronts_;
    groups.push_back(target);
    if (group.fronts == 0 && group.known_in != plan_.number) begin_group(state, target);
    front_.damp(g);
  }
  const FrontVariable v = front_.variables()[index].variable;
  front_.tie(index, g, place(state, v) - place(state, g));
}

LeafTree::Box Grouping::reach(const std::vector<int>& groups) const {
  LeafTree::Box box;
  for (const int g : groups) {
    const LeafTree::Box& own = records_.tree.box(g);
    const Eigen::Vector2d margin =
        Eigen::Vector2d::Constant(0.5 * records_.options.grain * own.diagonal().norm());
    box.extend(LeafTree::Box(own.min() - margin, own.max() + margin));
  }
  return box;
}

}  // namespace seif
