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
  list_candidates(nothing_is_far);
  if (count_unknowns(nothing_is_far) > records_.options.most_unknowns) {
    constexpr std::array ratios{8.0, 4.0, 2.0, 1.0};
    list_candidates(ratios.back() * records_.options.grain);
    for (const double ratio : ratios) {
      if (count_unknowns(ratio * records_.options.grain) <= records_.options.most_unknowns) break;
    }
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

/// The groups that each variable of the front may be tied to: nodes above it, from below. Where a part of the front has
/// it in a group already, it goes where that goes. Whether a group may be is the same for all that stand below its
/// node: a front has all of them in it, or none.
void Grouping::list_candidates(double least_ratio) {
  candidates_.clear();
  first_candidate_.assign(1, 0);
  for (const Front::Variable& v : front_.variables()) {
    add_candidates(v.variable, least_ratio);
    first_candidate_.push_back(candidates_.size());
  }
}

void Grouping::add_candidates(FrontVariable v, double least_ratio) {
  if (!is_group(v) && records_.node(records_.landmark(v).leaf).next_hot) return;
  const bool may_begin = allowed_ && least_ratio < nothing_is_far;
  for (int n = records_.node_of(v); n != none; n = records_.tree.parent(n)) {
    const LandmarkGroup& group = records_.node(n).group;
    const bool is_present = group.present_in == fronts_;
    const double ratio = may_begin ? distance_ratio(n) : 0.0;
    const bool is_far = may_begin && ratio >= least_ratio;
    // A leaf may be wider than the rectangles above it, and nearer.
    if (!is_far && !any_present_ && !records_.tree.is_leaf(n)) break;
    const bool may_be_tied = is_far && (group.fronts == 0 || group.known_in == plan_.number);
    if (is_present || may_be_tied) candidates_.push_back({n, may_be_tied ? ratio : 0.0, is_present});
  }
}

/// The node of the largest group that is present or farther than `ratio` times its size, or none.
int Grouping::target_of(std::size_t index, double ratio) const {
  for (std::size_t i = first_candidate_[index + 1]; i-- > first_candidate_[index];) {
    if (candidates_[i].is_present || candidates_[i].ratio >= ratio) return candidates_[i].node;
  }
  return none;
}

/// What is farther than `ratio` times its size is tied.
void Grouping::list_targets(double ratio) {
  ++counts_;
  targets_.clear();
  for (const Front::Variable& v : front_.variables()) {
    const int target = target_of(targets_.size(), ratio);
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
