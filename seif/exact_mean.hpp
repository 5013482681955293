// The exact mean after every update, by sparse Cholesky: not in constant time.
#pragma once

#include <cstdint>
#include <vector>

#include "seif/mean_keeper.hpp"

namespace seif {

class ExactMean final : public MeanKeeper {
 public:
  [[nodiscard]] bool activate(InformationState& state, std::vector<int>& slots, double range) override;
  [[nodiscard]] bool solve_window(InformationState& state) override;
  void join(const InformationState& /*state*/, int /*slot*/) override {}
  [[nodiscard]] bool end_update(InformationState& state) override;
  Eigen::Vector2d mean(const InformationState& state, int slot) const override { return state.mean(slot); }
  std::int64_t blocks_touched() const override { return 0; }  // the state counts all of them
  std::size_t memory_bytes() const override;

 private:
  Eigen::VectorXd step_;  // (w x 1), with room to grow
};

}  // namespace seif
