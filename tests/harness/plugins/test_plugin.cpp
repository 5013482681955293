// One source for many plug-ins: TEST_PLUGIN says which one it becomes.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "seif/option_table.hpp"
#include "seif/plugin.hpp"

namespace {

struct DeadReckoningOptions {
  int throw_after = 0;  // [-] scans; 0: never
};

/// Odometry alone.
class DeadReckoning final : public seif::Estimator {
 public:
  DeadReckoning(const seif::EstimatorSetup& setup, const DeadReckoningOptions& options)
      : pose_(setup.start.mean), options_(options) {}

  void motion_update(const seif::Odometry& odometry) override { pose_ = pose_ * odometry.T_previous_current; }
  void measurement_update(const seif::Scan&, const seif::StageDone& done) override {
    if (++scans_ == options_.throw_after) throw 42;
    done(seif::Stage::measurement);
  }
  seif::Pose2 pose() const override { return pose_; }
  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override { return {}; }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId>) const override {
    return std::nullopt;
  }

 private:
  seif::Pose2 pose_;
  DeadReckoningOptions options_;
  int scans_ = 0;
};

seif::EstimatorType type_named(const char* name) {
  seif::OptionTable<DeadReckoningOptions> table;
  table.number(
      "throw_after", [](DeadReckoningOptions& o) -> int& { return o.throw_after; }, {.min = 0, .max = 1e6},
      "Throws a number at this scan [-]; 0: never.");
  return {.name = name,
          .help = "Odometry alone.",
          .options = table.specs(),
          .make = [table](const seif::EstimatorSetup& setup, const seif::Options& options) {
            return std::make_unique<DeadReckoning>(setup, table.read(options));
          }};
}

void good(seif::Registry& registry) { registry.add(type_named("plugged_in")); }
/// As good(), but with another function that makes the estimator.
template <class Make>
void add_with(seif::Registry& registry, const Make& make) {
  seif::EstimatorType type = type_named("plugged_in");
  type.make = make;
  registry.add(type);
}

using Made = std::unique_ptr<seif::Estimator>;
[[maybe_unused]] void throws_when_made(seif::Registry& registry) {
  add_with(registry, [](const seif::EstimatorSetup&, const seif::Options&) -> Made { throw 42; });
}
[[maybe_unused]] void makes_nothing(seif::Registry& registry) {
  add_with(registry, [](const seif::EstimatorSetup&, const seif::Options&) -> Made { return nullptr; });
}
[[maybe_unused]] void adds_nothing(seif::Registry&) {}
[[maybe_unused]] void takes_a_name(seif::Registry& registry) { registry.add(type_named("ekf")); }
[[maybe_unused]] void throws(seif::Registry&) { throw std::runtime_error("the moon is not full"); }
[[maybe_unused]] void throws_a_number(seif::Registry&) { throw 42; }
void other_interface(seif::Registry& registry) { good(registry); }
void other_alignment(seif::Registry& registry) { good(registry); }

seif::PluginBuild build_of(void (*which)(seif::Registry&)) {
  seif::PluginBuild build;
  if (which == other_interface) build.interface += 1;
  if (which == other_alignment) build.eigen_alignment = 128;
  return build;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const seif::Plugin* seif_plugin() {
  static const seif::Plugin plugin{build_of(TEST_PLUGIN), TEST_PLUGIN};
  return &plugin;
}
