// Which leaf a landmark that joins the map goes to. Makes new leaves.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "seif/tree/condensation_plan.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/hot_zone.hpp"
#include "seif/tree/plan_marking.hpp"
#include "seif/tree/zone_choice.hpp"

namespace seif {

class LeafChoice {
 public:
  LeafChoice(CondensationRecords& records, CondensationPlan& plan, PlanMarking& marking, const HotZone& zone,
             const ZoneChoice& choice)
      : records_(records), plan_(plan), marking_(marking), zone_(zone), choice_(choice) {}

  /// For a landmark at p_world, in the zone: the nearest hot leaf that has room, or a new one.
  int in_zone(const Eigen::Vector2d& p_world, const Eigen::Vector2d& home);

  /// For a landmark anywhere, while no plan runs: the nearest leaf of the same news that has room, or a new cold one.
  int anywhere(const Eigen::Vector2d& home);
  void begin_news() { of_news_.clear(); }

  /// Puts a leaf that stands beside the tree into it, by the middle of its box.
  void attach(int leaf);

 private:
  static constexpr int none = -1;
  bool has_room(int leaf) const;
  int new_leaf(const Eigen::Vector2d& home);
  void make_nodes();

  CondensationRecords& records_;
  CondensationPlan& plan_;
  PlanMarking& marking_;
  const HotZone& zone_;
  const ZoneChoice& choice_;
  std::vector<int> of_news_;  // leaves
};

}  // namespace seif
