#include "harness/paper/drawn_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "harness/paper/figures.hpp"
#include "harness/run/prepared_run.hpp"

namespace harness {

namespace {

constexpr std::array<std::string_view, 3> drawn = {"ekf", "seif_report", "seif"};

/// Keeps the robot's last true pose.
class LastTruth final : public RunListener {
 public:
  void odometry(const OdometryEvent& event) override { note(event.truth); }
  void scan(const ScanEvent& event) override { note(event.truth); }
  void update(std::size_t, const UpdateRecord&) override {}

  const seif::Pose2& pose() const { return pose_; }

 private:
  void note(const std::optional<TruePose>& truth) {
    if (truth) pose_ = truth->T_world_robot;
  }

  seif::Pose2 pose_;
};

const Belief* find(const std::vector<Belief>& beliefs, std::string_view estimator) {
  const auto belief = std::ranges::find(beliefs, estimator, &Belief::estimator);
  return belief == beliefs.end() ? nullptr : &*belief;
}

}  // namespace

std::vector<Belief> drawn_beliefs(const PaperPlan& plan, const seif::Registry& registry) {
  worlds::World world = paper_world(plan, plan.first_seed, registry);
  std::erase_if(world.estimators, [](const worlds::EstimatorChoice& choice) {
    return std::ranges::find(drawn, choice.name) == drawn.end();
  });
  std::ranges::sort(world.estimators, {}, [](const worlds::EstimatorChoice& choice) {
    return std::ranges::find(drawn, choice.name) - drawn.begin();
  });
  PreparedRun run = prepare_run(world, registry);
  LastTruth truth;
  const RunResult result = execute_in_passing(run, &truth);
  if (!result.error.empty()) throw std::runtime_error(result.error);
  if (result.summary.interrupted) throw std::runtime_error("interrupted");
  std::vector<Belief> beliefs;
  for (const LiveEstimator& estimator : run.believers->estimators)
    beliefs.push_back(belief_of(estimator, *run.log->landmarks, truth.pose()));
  return beliefs;
}

std::string draw_figures(const PaperPlan& plan, const seif::Registry& registry) {
  std::vector<Picture> pictures;
  try {
    const std::vector<Belief> beliefs = drawn_beliefs(plan, registry);
    if (const Belief* ekf = find(beliefs, "ekf")) pictures.push_back(figure_1(*ekf));
    if (const Belief* seif = find(beliefs, "seif_report")) pictures.push_back(figure_2(*seif));
    pictures.push_back(figure_6(beliefs));
  } catch (const std::exception& error) {
    return fmt::format("no figures: {}", error.what());
  }
  for (const Picture& picture : pictures) {
    const std::string complaint = draw_picture(picture, plan.folder);
    if (!complaint.empty()) return complaint;
  }
  return {};
}

}  // namespace harness
