// Properties that hold for every run, whatever its world.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/run/prepared_run.hpp"
#include "harness/stream/run_listener.hpp"

namespace soak {

/// Follows a run and collects the properties that it violates.
class Invariants final : public harness::RunListener {
 public:
  /// Keeps a reference to `believers`.
  explicit Invariants(const harness::Believers& believers) : believers_(believers) {}

  void odometry(const harness::OdometryEvent& event) override;
  void scan(const harness::ScanEvent& event) override;
  void update(std::size_t estimator, const harness::UpdateRecord& record) override;
  void consistency(std::size_t estimator, const harness::ConsistencyRecord& record) override;
  void map(std::size_t estimator, std::span<const harness::MapRecord> landmarks) override;

  /// One line for each violated property; empty if all hold.
  const std::vector<std::string>& broken() const { return broken_; }

 private:
  void require(bool holds, std::size_t estimator, double t, const char* what);
  void require_proper_belief(std::size_t estimator, double t);

  const harness::Believers& believers_;
  double last_t_ = -1.0;          // [s]
  std::size_t largest_scan_ = 0;  // [-]
  std::size_t observations_ = 0;  // [-]
  std::vector<std::string> broken_;
};

}  // namespace soak
