#include "fixtures.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "harness/estimators/registry.hpp"
#include "harness/run/prepared_run.hpp"

namespace harness::test {

namespace {

class DeadReckoning final : public seif::Estimator {
 public:
  DeadReckoning(const seif::EstimatorSetup& setup, std::int64_t fail_after_scans)
      : belief_(setup.start), scans_left_(fail_after_scans) {}

  void motion_update(const seif::Odometry& odometry) override {
    belief_.mean = belief_.mean * odometry.T_previous_current;
  }
  void measurement_update(const seif::Scan&, const seif::StageDone& done) override {
    if (scans_left_ > 0 && --scans_left_ == 0) throw std::runtime_error("gave up");
    done(seif::Stage::measurement);
  }
  seif::Pose2 pose() const override { return belief_.mean; }
  seif::Counts counts() const override { return {}; }
  std::size_t memory_bytes() const override { return sizeof *this; }
  std::vector<seif::LandmarkEstimate> map() const override { return {}; }
  std::optional<seif::MarginalCovariances> marginal_covariances(
      std::span<const seif::LandmarkId>) const override {
    return seif::MarginalCovariances{belief_.covariance, {}};
  }

 private:
  seif::PoseEstimate belief_;
  std::int64_t scans_left_;
};

RunResult run_in(const std::filesystem::path& folder, PreparedRun run) {
  std::filesystem::create_directories(folder);
  run.plan.folder = folder;
  run.plan.quiet = true;
  return execute(run);
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

seif::Registry test_registry() {
  seif::Registry registry = known_estimators();
  seif::EstimatorType type;
  type.name = "dead_reckoning";
  type.help = "Odometry alone.";
  type.options.push_back({.key = "fail_after_scans", .fallback = std::int64_t{0}, .choices = {}, .help = ""});
  type.make = [](const seif::EstimatorSetup& setup, const seif::Options& options) {
    return std::make_unique<DeadReckoning>(setup, seif::option<std::int64_t>(options, "fail_after_scans"));
  };
  registry.add(std::move(type));
  return registry;
}

worlds::EstimatorChoice choice(const std::string& type) {
  worlds::EstimatorChoice result;
  result.name = type;
  result.type = type;
  const seif::Registry registry = test_registry();
  for (const seif::OptionSpec& option : registry.find(type)->options)
    result.options[option.key] = option.fallback;
  return result;
}

worlds::World small_world() {
  worlds::World world;
  world.name = "small";
  world.seed = 3;
  world.duration = 20.0;
  world.robot.start = {{3.0, -3.0}, 1.5707963267948966};
  world.drive.mode = worlds::DriveMode::loop;
  world.drive.path = {{3, 3}, {-3, 3}, {-3, -3}, {3, -3}};
  world.drive.closed = true;
  world.scoring.interval = 5.0;
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5 * i;
    world.landmarks.push_back({{6.0 * std::cos(angle), 6.0 * std::sin(angle)}, 0.1});
  }
  world.estimators = {choice("ekf"), choice("seif_report")};
  return world;
}

RunResult run_live(const worlds::World& world, const std::filesystem::path& folder) {
  return run_live(world, folder, test_registry());
}

RunResult run_live(const worlds::World& world, const std::filesystem::path& folder,
                   const seif::Registry& registry) {
  return run_in(folder, prepare_run(world, registry));
}

RunResult replay(const worlds::World& world, const std::filesystem::path& from,
                 const std::filesystem::path& to) {
  return run_in(to, prepare_replay(from, world, test_registry()));
}

}  // namespace harness::test
