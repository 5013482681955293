// The estimators of this library under their names, with the options that world files may set.

#include <map>
#include <memory>
#include <string>

#include "seif/eif.hpp"
#include "seif/ekf.hpp"
#include "seif/registry.hpp"
#include "seif/seif.hpp"

namespace seif {
namespace {

const std::map<std::string, DropOrder> drop_orders{{"weakest_link", DropOrder::weakest_link},
                                                   {"weakest_out_of_view", DropOrder::weakest_out_of_view},
                                                   {"least_recently_seen", DropOrder::least_recently_seen}};

const OptionSpec theta_x{.key = "theta_x",
                         .fallback = std::int64_t{6},
                         .min = 2,
                         .max = 1000,
                         .help = "Landmarks that keep their link to the robot when an update ends [-]."};
const OptionSpec drop{
    .key = "drop",
    .fallback = std::string("weakest_out_of_view"),
    .choices = {"weakest_link", "weakest_out_of_view", "least_recently_seen"},
    .help =
        "Which landmarks lose their link to the robot first; weakest_link is the report to the "
        "letter, and breaks down where more than theta_x landmarks are in view."};
const OptionSpec K{
    .key = "K",
    .fallback = std::int64_t{10},
    .min = 0,
    .max = 1'000'000,
    .help = "Random landmarks that the mean recovery relaxes in each update, beside the active ones [-]."};

template <class Filter>
EstimatorType without_options(const std::string& name, const std::string& help) {
  return {.name = name, .help = help, .options = {}, .make = [](const EstimatorSetup& setup, const Options&) {
            return std::make_unique<Filter>(setup);
          }};
}

/// A SEIF with a fixed rule and mean recovery.
EstimatorType seif_type(const std::string& name, const std::string& help, SparsificationRule rule,
                        MeanRecovery mean_recovery) {
  std::vector<OptionSpec> specs{theta_x, drop};
  if (mean_recovery == MeanRecovery::coordinate_descent) specs.push_back(K);
  return {.name = name,
          .help = help,
          .options = specs,
          .make = [rule, mean_recovery](const EstimatorSetup& setup, const Options& options) {
            SeifOptions chosen{.theta_x = static_cast<int>(option<std::int64_t>(options, theta_x.key)),
                               .rule = rule,
                               .drop = drop_orders.at(option<std::string>(options, drop.key)),
                               .mean_recovery = mean_recovery};
            if (mean_recovery == MeanRecovery::coordinate_descent) {
              chosen.random_landmarks = static_cast<int>(option<std::int64_t>(options, K.key));
            }
            return std::make_unique<Seif>(setup, chosen);
          }};
}

}  // namespace

Registry standard_estimators() {
  Registry registry;
  registry.add(without_options<Ekf>(
      "ekf", "The dense extended Kalman filter: exact up to linearisation, quadratic time; the baseline."));
  registry.add(without_options<Eif>(
      "eif", "The dense extended information filter: exact up to linearisation, cubic time; the oracle."));
  registry.add(seif_type(
      "seif_report",
      "The report's SEIF in constant time, faithful to its sparsification rule and so overconfident.",
      SparsificationRule::report, MeanRecovery::coordinate_descent));
  registry.add(seif_type(
      "seif_exact",
      "The report's SEIF with its mean recovered exactly: not in constant time; the second row of its "
      "table.",
      SparsificationRule::report, MeanRecovery::exact));
  registry.add(
      seif_type("seif_modified",
                "The SEIF with Eustice's modified rule and exact mean: not in constant time; an oracle for "
                "consistent sparsification.",
                SparsificationRule::modified, MeanRecovery::exact));
  return registry;
}

}  // namespace seif
