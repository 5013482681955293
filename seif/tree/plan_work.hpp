// Does the work of a plan in small steps: reads, carries the elements of hot leaves, and makes one message after the
// other.
#pragma once

#include <cstdint>
#include <vector>

#include "seif/information_state.hpp"
#include "seif/tree/condensation_plan.hpp"
#include "seif/tree/condensation_records.hpp"
#include "seif/tree/front.hpp"
#include "seif/tree/grouping.hpp"
#include "seif/tree/leaf_element.hpp"
#include "seif/tree/mean_reader.hpp"

namespace seif {

class PlanWork {
 public:
  PlanWork(CondensationRecords& records, CondensationPlan& plan, Front& front, Grouping& grouping,
           MeanReader& reader)
      : records_(records), plan_(plan), front_(front), grouping_(grouping), reader_(reader) {}

  /// One step, if the plan is not ready yet. False if a matrix is not positive definite.
  [[nodiscard]] bool step(const InformationState& state);

  std::int64_t blocks_touched() const { return blocks_touched_; }

 private:
  static constexpr int none = -1;
  bool is_stale(int at) const { return records_.node(at).stale_in == plan_.number; }
  const SentMessage& next_of(int at) const;
  SentMessage& current() { return plan_.messages[plan_.ready]; }
  void carry(int leaf);
  void begin_message(const InformationState& state, int at);
  bool is_bare(int at) const;
  void begin_bare(int at, SentMessage& next);
  template <class Visit>
  void for_each_next_source(int at, Visit&& visit) const;
  void gather(int at);
  bool is_complete(int at, FrontVariable v, int balance) const;
  void finish_message();
  void note_reach(int at, SentMessage& next) const;

  CondensationRecords& records_;
  CondensationPlan& plan_;
  Front& front_;
  Grouping& grouping_;
  MeanReader& reader_;
  bool is_in_front_ = false;  // a message has begun, and is not finished
  std::vector<MovedPlace> places_;
  ElementMover element_mover_;
  std::int64_t blocks_touched_ = 0;
};

}  // namespace seif
