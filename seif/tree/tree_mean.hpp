// Mean recovery with a condensation tree, for Seif.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seif/mean_keeper.hpp"
#include "seif/tree/condensation_tree.hpp"

namespace seif {

class TreeMean final : public MeanKeeper {
 public:
  TreeMean(const CondensationOptions& options, const Pose2& start) : tree_(options, start) {}

  [[nodiscard]] bool activate(InformationState& state, std::vector<int>& slots, double range) override {
    return tree_.activate(state, slots, range);
  }
  [[nodiscard]] bool solve_window(InformationState& state) override { return tree_.solve_window(state); }
  void join(const InformationState& state, int slot) override { tree_.join(state, slot); }
  [[nodiscard]] bool freeze(const InformationState& state, const FrozenPiece& piece) override {
    return tree_.freeze(state, piece);
  }
  [[nodiscard]] bool end_update(InformationState& state) override;
  Eigen::Vector2d mean(const InformationState& state, int slot) const override {
    return tree_.mean(state, slot);
  }
  const WindowFactor* window_factor() const override { return &tree_.window_factor(); }
  std::int64_t blocks_touched() const override { return tree_.blocks_touched(); }
  std::size_t memory_bytes() const override { return tree_.memory_bytes(); }

  CondensationTree& tree() { return tree_; }
  const CondensationTree& tree() const { return tree_; }

 private:
  CondensationTree tree_;
};

}  // namespace seif
