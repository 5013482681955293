#include "seif/seif_report.hpp"

#include <map>
#include <memory>
#include <string>

#include "seif/marginals.hpp"
#include "seif/mean_recovery.hpp"
#include "seif/measurement_update.hpp"
#include "seif/motion_update.hpp"
#include "seif/sparsification.hpp"

namespace seif {
namespace {

const std::map<std::string, DropOrder> drop_orders{{"weakest_link", DropOrder::weakest_link},
                                                   {"weakest_out_of_view", DropOrder::weakest_out_of_view},
                                                   {"least_recently_seen", DropOrder::least_recently_seen}};

SeifReportOptions options_from(const Options& options) {
  return {.theta_x = static_cast<int>(option<std::int64_t>(options, "theta_x")),
          .drop = drop_orders.at(option<std::string>(options, "drop")),
          .random_landmarks = static_cast<int>(option<std::int64_t>(options, "K"))};
}

}  // namespace

SeifReport::SeifReport(const EstimatorSetup& setup, const SeifReportOptions& options)
    : state_(setup.start), options_(options), T_robot_sensor_(setup.T_robot_sensor), random_(setup.random) {}

void SeifReport::motion_update(const Odometry& odometry) { seif::motion_update(state_, odometry); }

void SeifReport::measurement_update(const Scan& scan, const StageDone& done) {
  seif::measurement_update(state_, scan.observations, T_robot_sensor_);
  done(Stage::measurement);

  if (const int surplus = state_.active_count() - options_.theta_x; surplus > 0) {
    choose_to_drop(state_, options_.drop, surplus, to_deactivate_);
    if (!sparsify_report(state_, to_deactivate_)) throw NumericalFailure("sparsification", scan.t);
  }
  done(Stage::sparsification);

  if (!coordinate_descent(state_, options_.random_landmarks, random_))
    throw NumericalFailure("mean recovery", scan.t);
  done(Stage::mean_recovery);
}

Counts SeifReport::counts() const {
  return {.blocks_touched = state_.blocks_touched(),
          .active_landmarks = state_.active_count(),
          .links = state_.link_count()};
}

std::vector<LandmarkEstimate> SeifReport::map() const { return map_of(state_); }

std::optional<MarginalCovariances> SeifReport::marginal_covariances(
    std::span<const LandmarkId> landmarks) const {
  return marginals_of(state_, landmarks);
}

EstimatorType seif_report_type() {
  return {
      .name = "seif_report",
      .help = "The report's SEIF in constant time, faithful to its sparsification rule and so overconfident.",
      .options = {{.key = "theta_x",
                   .fallback = std::int64_t{6},
                   .min = 2,
                   .max = 1000,
                   .help = "Landmarks that keep their link to the robot when an update ends [-]."},
                  {.key = "drop",
                   .fallback = std::string("weakest_out_of_view"),
                   .choices = {"weakest_link", "weakest_out_of_view", "least_recently_seen"},
                   .help = "Which landmarks lose their link to the robot first; weakest_link is the report "
                           "to the letter, "
                           "and breaks down where more than theta_x landmarks are in view."},
                  {.key = "K",
                   .fallback = std::int64_t{10},
                   .min = 0,
                   .max = 1'000'000,
                   .help = "Random landmarks that the mean recovery relaxes in each update, beside the "
                           "active ones [-]."}},
      .make = [](const EstimatorSetup& setup, const Options& options) -> std::unique_ptr<Estimator> {
        return std::make_unique<SeifReport>(setup, options_from(options));
      }};
}

}  // namespace seif
