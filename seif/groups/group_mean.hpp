// Mean recovery by rigid groups of landmarks of every size, for Seif.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "seif/groups/multilevel_mean.hpp"
#include "seif/mean_keeper.hpp"

namespace seif {

class GroupMean final : public MeanKeeper {
 public:
  explicit GroupMean(const MultilevelOptions& options) : groups_(options) {}

  [[nodiscard]] bool activate(InformationState& state, std::vector<int>& slots, double range) override;
  [[nodiscard]] bool before_information(const InformationState& state) override {
    return groups_.before_information(state);
  }
  [[nodiscard]] bool after_information(const InformationState& state) override {
    return groups_.after_information(state);
  }
  [[nodiscard]] bool solve_window(InformationState& state) override { return groups_.solve_window(state); }
  void join(const InformationState& state, int slot) override { groups_.join(state, slot); }
  [[nodiscard]] bool end_update(InformationState& state) override { return groups_.correct(state); }
  Eigen::Vector2d mean(const InformationState& state, int slot) const override {
    return groups_.mean(state, slot);
  }
  std::int64_t blocks_touched() const override { return groups_.blocks_touched(); }
  std::optional<double> residual() const override { return groups_.residual(); }
  std::size_t memory_bytes() const override { return groups_.memory_bytes(); }

 private:
  MultilevelMean groups_;
};

}  // namespace seif
