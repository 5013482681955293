// The estimators of this library under their names, with the options that world files may set.

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "seif/association/associating_filter.hpp"
#include "seif/dense/eif.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/eseif.hpp"
#include "seif/registry.hpp"
#include "seif/report_seif.hpp"
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
const OptionSpec theta_max{
    .key = "theta_max",
    .fallback = std::int64_t{16},
    .min = 2,
    .max = 1000,
    .help = "Links of the robot above which all but theta_x are dropped in one burst [-]."};
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

const OptionSpec gate{.key = "gate",
                      .fallback = 0.0,
                      .min = 0.0,
                      .help =
                          "An observation of a known landmark is left out if its squared innovation, "
                          "normalised, is above this; "
                          "0: never; 13.8 leaves out one in a thousand that are right [-]."};

const OptionSpec robust_above{
    .key = "robust_above",
    .fallback = 0.0,
    .min = 0.0,
    .help =
        "An observation of a known landmark whose innovation is more than this many sigma counts less, by "
        "Huber's weight; 0: never; 3 is usual [sigma]."};

template <class Filter>
EstimatorType without_options(const std::string& name, const std::string& help) {
  return {.name = name, .help = help, .options = {}, .make = [](const EstimatorSetup& setup, const Options&) {
            return std::make_unique<Filter>(setup);
          }};
}

int integer(const Options& options, const OptionSpec& spec) {
  return static_cast<int>(option<std::int64_t>(options, spec.key));
}

const std::map<std::string, SeifMean> seif_means{
    {"multilevel", SeifMean::multilevel}, {"tree", SeifMean::tree}, {"exact", SeifMean::exact}};

// Finding out which landmark is seen.

const OptionSpec association{.key = "association",
                             .fallback = std::string("known"),
                             .choices = {"known", "nearest", "joint"},
                             .help =
                                 "Which landmark is seen: as the observation says; each for itself the "
                                 "nearest that is compatible; or the most that are compatible together, "
                                 "whatever the observations say."};
const OptionSpec match_probability{.key = "match_probability",
                                   .fallback = AssociationOptions{}.match_probability,
                                   .min = 1e-12,
                                   .max = 0.5,
                                   .help = "With an association: that a right pair is left out [-]."};
const OptionSpec new_probability{
    .key = "new_probability",
    .fallback = AssociationOptions{}.new_probability,
    .min = 1e-15,
    .max = 0.5,
    .help = "With an association: that what is of a known landmark is taken for something new [-]."};
const OptionSpec admit_after{
    .key = "admit_after",
    .fallback = std::int64_t{AssociationOptions{}.admit_after},
    .min = 1,
    .max = 1000,
    .help = "With an association: scans that must have seen it before a landmark joins the map [-]."};
const OptionSpec forget_after{
    .key = "forget_after",
    .fallback = std::int64_t{AssociationOptions{}.forget_after},
    .min = 1,
    .max = 100'000,
    .help = "With an association: scans without it after which it is forgotten, until it has joined [-]."};
const OptionSpec remove_below{.key = "remove_below",
                              .fallback = AssociationOptions{}.remove_below,
                              .min = 0.0,
                              .max = 1.0,
                              .help =
                                  "With an association: a landmark that was seen in less than this share of "
                                  "the scans that should have seen it is taken out; 0: never [-]."};

std::vector<OptionSpec> with_association(std::vector<OptionSpec> options) {
  options.insert(options.end(),
                 {association, match_probability, new_probability, admit_after, forget_after, remove_below});
  return options;
}

/// The filter itself where associations are known.
std::unique_ptr<Estimator> associating(std::unique_ptr<AssociableFilter> filter, const EstimatorSetup& setup,
                                       const Options& options) {
  const auto& how = option<std::string>(options, association.key);
  if (how == "known") return filter;
  return std::make_unique<AssociatingFilter>(
      std::move(filter), setup,
      AssociationOptions{.jointly = how == "joint",
                         .match_probability = option<double>(options, match_probability.key),
                         .new_probability = option<double>(options, new_probability.key),
                         .admit_after = integer(options, admit_after),
                         .forget_after = integer(options, forget_after),
                         .remove_below = option<double>(options, remove_below.key)});
}

EstimatorType seif_report() {
  return {
      .name = "seif_report",
      .help = "The report's SEIF in constant time, faithful to its sparsification rule and so overconfident.",
      .options = {theta_x, drop, K},
      .make = [](const EstimatorSetup& setup, const Options& options) {
        return std::make_unique<ReportSeif>(
            setup, ReportSeifOptions{.theta_x = integer(options, theta_x),
                                     .drop = drop_orders.at(option<std::string>(options, drop.key)),
                                     .random_landmarks = integer(options, K)});
      }};
}

/// A SEIF that sparsifies at once, as the report's does, and solves for its mean.
EstimatorType seif_with_exact_mean(const std::string& name, const std::string& help,
                                   SparsificationRule rule) {
  return {.name = name,
          .help = help,
          .options = {theta_x, drop},
          .make = [rule](const EstimatorSetup& setup, const Options& options) {
            return std::make_unique<ReportSeif>(
                setup, ReportSeifOptions{.theta_x = integer(options, theta_x),
                                         .rule = rule,
                                         .drop = drop_orders.at(option<std::string>(options, drop.key)),
                                         .mean_recovery = MeanRecovery::exact});
          }};
}

EstimatorType seif() {
  const SeifOptions defaults;
  const OptionSpec first_estimates{
      .key = "first_estimates",
      .fallback = std::int64_t{defaults.first_estimates},
      .min = 0,
      .max = 1000,
      .help =
          "Scans after which a landmark's first estimate is settled at the latest, which fixes what the "
          "filter cannot observe; 0: none [-]."};
  const OptionSpec relinearise_above{
      .key = "relinearise_above",
      .fallback = defaults.relinearise_above,
      .min = 0.0,
      .help = "Nonlinearity of an observation above which it is linearised again after the update [sigma]."};
  const OptionSpec closing_gate{
      .key = "closing_gate",
      .fallback = defaults.closing_gate,
      .min = 0.0,
      .help =
          "An observation is linearised at what was measured if that is farther from where the landmark is "
          "believed to be than so many times the range; 0: never [-]."};
  const OptionSpec mean_recovery{
      .key = "mean_recovery",
      .fallback = std::string("tree"),
      .choices = {"tree", "multilevel", "exact"},
      .help =
          "How the mean is recovered: along a condensation tree, exactly in corridors and nearly so in "
          "areas; by rigid groups, slowly after a closure but in least memory; exactly, not in constant "
          "time."};
  const OptionSpec tree_unknowns{
      .key = "tree_unknowns",
      .fallback = std::int64_t{defaults.tree.most_unknowns},
      .min = 8,
      .max = 1'000'000,
      .help =
          "With the tree: unknowns about one node beyond which landmarks far from the robot move as rigid "
          "groups [-]."};
  const OptionSpec tree_grain{
      .key = "tree_grain",
      .fallback = defaults.tree.grain,
      .min = 0.1,
      .max = 100.0,
      .help = "With the tree: distance from the robot over size of the coarsest groups [-]."};
  const OptionSpec tree_blocks{
      .key = "tree_blocks",
      .fallback = std::int64_t{defaults.tree.most_blocks},
      .min = 0,
      .max = 1'000'000'000,
      .help =
          "With the tree: blocks that an update makes ready for the next zone, or more "
          "where the robot would be there before it is ready; 0: all at once, and no "
          "observation has to wait [-]."};
  const OptionSpec other_groups{
      .key = "other_groups",
      .fallback = std::int64_t{defaults.multilevel.other_groups},
      .min = 0,
      .max = 1000,
      .help = "With groups: those of each level that an update moves, beside those about the robot [-]."};
  const OptionSpec relaxed_groups{
      .key = "relaxed_groups",
      .fallback = std::int64_t{defaults.multilevel.relaxed_groups},
      .min = 0,
      .max = 1000,
      .help = "With groups: those of about ten landmarks whose landmarks an update relaxes one by one [-]."};
  return {.name = "seif",
          .help =
              "Ours: gauge-free sparsification, null space from first estimates, mean along a tree; constant "
              "time.",
          .options = with_association({theta_x, theta_max, first_estimates, relinearise_above, closing_gate,
                                       gate, robust_above, mean_recovery, other_groups, relaxed_groups,
                                       tree_unknowns, tree_grain, tree_blocks}),
          .make = [=](const EstimatorSetup& setup, const Options& options) {
            SeifOptions chosen;
            chosen.theta_x = integer(options, theta_x);
            chosen.theta_max = integer(options, theta_max);
            chosen.first_estimates = integer(options, first_estimates);
            chosen.relinearise_above = option<double>(options, relinearise_above.key);
            chosen.closing_gate = option<double>(options, closing_gate.key);
            chosen.gate = option<double>(options, gate.key);
            chosen.robust_above = option<double>(options, robust_above.key);
            chosen.mean_recovery = seif_means.at(option<std::string>(options, mean_recovery.key));
            chosen.multilevel.other_groups = integer(options, other_groups);
            chosen.multilevel.relaxed_groups = integer(options, relaxed_groups);
            chosen.tree.most_unknowns = integer(options, tree_unknowns);
            chosen.tree.most_blocks = integer(options, tree_blocks);
            chosen.tree.grain = option<double>(options, tree_grain.key);
            if (chosen.mean_recovery != SeifMean::tree &&
                option<std::string>(options, association.key) != "known")
              throw std::invalid_argument("association needs mean_recovery: tree");
            return associating(std::make_unique<Seif>(setup, chosen), setup, options);
          }};
}

EstimatorType ekf() {
  return {
      .name = "ekf",
      .help = "The dense extended Kalman filter: exact up to linearisation, quadratic time; the baseline.",
      .options = with_association({gate, robust_above}),
      .make = [](const EstimatorSetup& setup, const Options& options) {
        return associating(std::make_unique<Ekf>(
                               setup, EkfOptions{.gate = option<double>(options, gate.key),
                                                 .robust_above = option<double>(options, robust_above.key)}),
                           setup, options);
      }};
}

EstimatorType seif_gauge_free() {
  return {
      .name = "seif_gauge_free",
      .help =
          "The SEIF with gauge-free sparsification in bursts and exact mean: not in constant time; what our "
          "rule alone costs.",
      .options = {theta_x, theta_max},
      .make = [](const EstimatorSetup& setup, const Options& options) {
        return std::make_unique<ReportSeif>(setup, ReportSeifOptions{.theta_x = integer(options, theta_x),
                                                                     .theta_max = integer(options, theta_max),
                                                                     .rule = SparsificationRule::gauge_free,
                                                                     .drop = DropOrder::least_recently_seen,
                                                                     .keep_in_view = true,
                                                                     .mean_recovery = MeanRecovery::exact});
      }};
}

EstimatorType eseif() {
  const EseifOptions defaults;
  OptionSpec bound = theta_x;
  bound.fallback = std::int64_t{defaults.theta_x};
  bound.help = "Links of the robot above which it is marginalised out and relocated [-].";
  const OptionSpec relocation_landmarks{
      .key = "relocation_landmarks",
      .fallback = std::int64_t{defaults.relocation_landmarks},
      .min = 2,
      .max = 1000,
      .help = "Observations that are held back to relocate the robot from [-]."};
  return {
      .name = "eseif",
      .help =
          "The exactly sparse filter of Walter, Eustice and Leonard with exact mean: not in constant time.",
      .options = {bound, relocation_landmarks},
      .make = [bound, relocation_landmarks](const EstimatorSetup& setup, const Options& options) {
        return std::make_unique<Eseif>(
            setup, EseifOptions{.theta_x = integer(options, bound),
                                .relocation_landmarks = integer(options, relocation_landmarks)});
      }};
}

}  // namespace

Registry standard_estimators() {
  Registry registry;
  registry.add(ekf());
  registry.add(without_options<Eif>(
      "eif", "The dense extended information filter: exact up to linearisation, cubic time; the oracle."));
  registry.add(seif_report());
  registry.add(seif_with_exact_mean(
      "seif_exact",
      "The report's SEIF with its mean recovered exactly: not in constant time; the second row of its table.",
      SparsificationRule::report));
  registry.add(
      seif_with_exact_mean("seif_modified",
                           "The SEIF with Eustice's modified rule and exact mean: not in constant time; an "
                           "oracle for consistent sparsification.",
                           SparsificationRule::modified));
  registry.add(seif());
  registry.add(seif_gauge_free());
  registry.add(eseif());
  return registry;
}

}  // namespace seif
