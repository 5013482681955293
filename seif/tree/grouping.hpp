// Which landmarks are tied together to groups, where a front would be too large.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/tree/condensation_plan.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/front.hpp"

namespace seif {

class Grouping {
 public:
  Grouping(CondensationRecords& records, const CondensationPlan& plan, Front& front)
      : records_(records), plan_(plan), front_(front) {}

  /// Whether groups may begin.
  void allow(bool allowed) { allowed_ = allowed; }
  /// Whether the next zone is too near to a group.
  bool is_expired(int group) { return distance_ratio(group) < 0.5 * records_.options.grain; }

  /// Ties variables of the front: to the finest groups that suffice, or the coarsest that are allowed. `next` gets the
  /// groups of the front.
  void tie_front(const InformationState& state, SentMessage& next);
  /// The box of these groups, with what the next zone may not enter.
  LeafTree::Box reach(const std::vector<int>& groups) const;

 private:
  static constexpr int none = -1;
  static constexpr double nothing_is_far = std::numeric_limits<double>::infinity();  // a ratio [-]
  /// A node whose group a variable may be tied to.
  struct Candidate {
    int node;
    double ratio;  // [-] as distance_ratio(); 0 if no group may begin there
    bool is_present;
  };

  double distance_ratio(int group);
  int note_present(std::vector<int>& groups);
  void list_candidates(double least_ratio);
  void add_candidates(FrontVariable v, double least_ratio);
  int target_of(std::size_t index, double ratio) const;
  void list_targets(double ratio);
  int count_unknowns(double ratio);
  Eigen::Vector2d place(const InformationState& state, FrontVariable v) const;
  void begin_group(const InformationState& state, int target);
  void tie(const InformationState& state, std::size_t index, std::vector<int>& groups);

  CondensationRecords& records_;
  const CondensationPlan& plan_;
  Front& front_;
  bool allowed_ = true;
  int fronts_ = 0, counts_ = 0;               // [-] so far: marks of groups
  bool any_present_ = false;                  // groups in the front, by what others have sent
  std::vector<Candidate> candidates_;         // of all variables of the front
  std::vector<std::size_t> first_candidate_;  // by variable; and the end
  std::vector<int> targets_;  // by variable of the front: the node whose group it is tied to, or none
};

}  // namespace seif
