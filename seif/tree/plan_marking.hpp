// Which messages have to be sent anew for the next zone, and in which order.
#pragma once

#include <span>
#include <vector>

#include "seif/tree/condensation_plan.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/grouping.hpp"

namespace seif {

/// Only messages that then say something else, or go elsewhere, are sent anew: those of nodes that leave the path and of
/// rings with other path nodes than before, those with groups that will be too near, and all that depend on them.
class PlanMarking {
 public:
  PlanMarking(CondensationRecords& records, CondensationPlan& plan, Grouping& grouping)
      : records_(records), plan_(plan), grouping_(grouping) {}

  /// A leaf that is new in the tree.
  void note_change(int leaf) { changed_.push_back(leaf); }
  /// A leaf with a landmark of which news have come. Until the zone has moved no group holds it: its landmarks move
  /// against each other.
  void note_news(int leaf) { news_.push_back(leaf); }
  /// Whether it is such a leaf, since the zone moved last.
  bool is_changed(int leaf) const;
  void forget_changes() {
    changed_.clear();
    news_.clear();
  }

  /// A plan for plan.hot_leaves.
  void begin();
  /// All nodes send anew.
  void begin_all();

 private:
  static constexpr int none = CondensationRecords::none;
  void reset();
  void find_path();
  void mark_changed();
  void mark_news();
  void finish();
  int next_receiver(int at) const;
  void mark_stale(int at);
  void mark_expired(int at);
  void note_groups(int at);
  void list_readings();
  void list_readings_below(int at);
  void put_in_order();
  void put_in_order(int at);
  bool is_stale(int at) const { return records_.node(at).stale_in == plan_.number; }

  CondensationRecords& records_;
  CondensationPlan& plan_;
  Grouping& grouping_;
  std::vector<int> changed_, news_;  // leaves
};

}  // namespace seif
