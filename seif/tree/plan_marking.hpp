// Which messages have to be sent anew for the next zone, and in which order.
#pragma once

#include <span>
#include <vector>

#include "seif/tree/condensation_plan.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/grouping.hpp"

namespace seif {

/// Only messages that then say something else, or go elsewhere, are sent anew: those on the way from a leaf that becomes
/// hot or cold to the hub, from the old hub to the new one, and those with groups that will be too near.
class PlanMarking {
 public:
  PlanMarking(CondensationRecords& records, CondensationPlan& plan, Grouping& grouping)
      : records_(records), plan_(plan), grouping_(grouping) {}

  /// A leaf that is new in the tree.
  void note_change(int leaf) { changed_.push_back(leaf); }
  /// Whether the leaf is new, since the zone moved last.
  bool is_changed(int leaf) const;
  void forget_changes() { changed_.clear(); }

  /// A plan for plan.hot_leaves.
  void begin() { finish(mark()); }
  /// All nodes send anew.
  void begin_all();

 private:
  int mark();
  void finish(int hub);
  void mark_changed_leaves();
  void mark_stale(int at);
  void mark_expired(int at);
  void note_groups(int at);
  void list_readings(int at);
  void put_in_order(int at);
  bool is_stale(int at) const { return records_.node(at).stale_in == plan_.number; }

  CondensationRecords& records_;
  CondensationPlan& plan_;
  Grouping& grouping_;
  std::vector<int> changed_;  // leaves that will have become hot or cold, or are new
};

}  // namespace seif
