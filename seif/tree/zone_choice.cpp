#include "seif/tree/zone_choice.hpp"

#include <algorithm>

namespace seif {

void ZoneChoice::begin_scan(const InformationState& state, std::span<const int> slots, double range) {
  ++scan_;
  constexpr double kept = 0.99;  // of it, at a scan that sees less far
  records_.view = std::max(range, kept * records_.view);
  note_travel(state);
  const auto use = [&](int slot) { records_.node(records_.landmark(slot).leaf).used = scan_; };
  for (int p = 0; p < state.active_count(); ++p) use(state.active(p));
  std::ranges::for_each(slots, use);
  std::ranges::for_each(wanted_, use);
}

Eigen::Vector2d ZoneChoice::middle(const Pose2& pose) const {
  return pose * Eigen::Vector2d(records_.options.zone_before * records_.view, 0.0);
}

void ZoneChoice::note_travel(const InformationState& state) {
  constexpr double kept = 0.95;  // of it, at an update that goes less far
  homes_.begin();
  for (int p = 0; p < state.active_count(); ++p)
    homes_.add(records_.landmark(state.active(p)).home, state.mean(state.active(p)));
  homes_.finish(0.5 * records_.view);
  const Eigen::Vector2d now = middle(state.pose());
  if (scan_ > 1) travel_ = std::max((now - last_middle_).norm(), kept * travel_);
  last_middle_ = now;
}

double ZoneChoice::updates_to_arrive() const {
  constexpr double fewest = 12.0;
  constexpr double most = 192.0;
  return std::clamp(records_.options.zone_before * records_.view / std::max(travel_, 1e-9), fewest, most);
}

bool ZoneChoice::choose(const InformationState& state, std::span<const int> slots, int zone_size,
                        std::vector<int>& chosen) {
  chosen.clear();
  landmarks_ = 0;
  for (int p = 0; p < state.active_count(); ++p) want_leaf(records_.landmark(state.active(p)).leaf, chosen);
  for (const int slot : slots) want_leaf(records_.landmark(slot).leaf, chosen);
  for (const int slot : wanted_) want_leaf(records_.landmark(slot).leaf, chosen);
  wanted_.clear();
  want_near(state, records_.options.look_ahead, chosen);
  const bool all_hot = std::ranges::all_of(chosen, [&](int leaf) { return records_.node(leaf).hot; });
  want_near(state, records_.options.zone_ahead, chosen);
  const bool may_stay =
      all_hot && zone_size <= std::max(records_.options.most_hot, landmarks_ + landmarks_ / 2);
  if (!may_stay) add_last_used(chosen);
  for (const int leaf : chosen) records_.node(leaf).wanted = false;
  return !may_stay && !(all_hot && chosen.size() == records_.hot_leaves.size());
}

bool ZoneChoice::is_bent(const InformationState& state) {
  constexpr double most = 0.05;        // of the view
  constexpr double most_sigmas = 3.0;  // of a sighting: what noise explains calls for no plan
  places_.clear();
  for (int p = 0; p < state.active_count(); ++p) {
    const int slot = state.active(p);
    places_.push_back({.before = records_.landmark(slot).planned, .now = state.mean(slot)});
  }
  boundary_.fit(records_.turning(), places_);
  double longest = 0.0;
  for (std::size_t i = 0; i < places_.size(); ++i) longest = std::max(longest, boundary_.step(i).norm());
  return longest > most * records_.view && longest > most_sigmas * state.first_estimates().sighting_sd();
}

void ZoneChoice::want_leaf(int leaf, std::vector<int>& chosen) {
  if (records_.node(leaf).wanted || leaf == records_.held_leaf) return;
  records_.node(leaf).wanted = true;
  landmarks_ += records_.node(leaf).landmarks;
  chosen.push_back(leaf);
}

/// Leaves stay where their landmarks first were, however a closure has bent the map since.
void ZoneChoice::want_near(const InformationState& state, double views, std::vector<int>& chosen) {
  if (records_.options.most_blocks == 0) return;  // what is wanted comes at once
  const Eigen::Vector2d p = middle(state.pose());
  const auto want = [&](int leaf) { want_leaf(leaf, chosen); };
  records_.tree.for_each_leaf_near(p + homes_.offset(), views * records_.view, want);
  if (const auto& other = homes_.other_offset())
    records_.tree.for_each_leaf_near(p + *other, views * records_.view, want);
}

/// As long as there is room.
void ZoneChoice::add_last_used(std::vector<int>& chosen) {
  std::ranges::sort(records_.hot_leaves, [&](int a, int b) {
    return records_.node(a).used != records_.node(b).used ? records_.node(a).used > records_.node(b).used
                                                          : a > b;
  });
  for (const int leaf : records_.hot_leaves) {
    if (records_.node(leaf).wanted) continue;
    landmarks_ += records_.node(leaf).landmarks;
    if (landmarks_ > records_.options.most_hot) break;
    records_.node(leaf).wanted = true;
    chosen.push_back(leaf);
  }
}

}  // namespace seif
