// The estimators of this library under their names, with the options that world files may set.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seif/association/associating_filter.hpp"
#include "seif/dense/eif.hpp"
#include "seif/dense/ekf.hpp"
#include "seif/eseif.hpp"
#include "seif/option_table.hpp"
#include "seif/plain_seif.hpp"
#include "seif/registry.hpp"
#include "seif/relocating/relocating_filter.hpp"
#include "seif/seif.hpp"
#include "seif/team/team_filter.hpp"

namespace seif {
namespace {

// Options that several estimators share.

constexpr double most_links = 1000.0;  // [-]

template <class Struct>
void add_theta_x(OptionTable<Struct>& table) {
  table
      .number(
          "theta_x", [](Struct& o) -> int& { return o.theta_x; }, {2, most_links},
          "Landmarks that keep their link to the robot when an update ends [-].")
      .changeable();
}

/// theta_x and theta_max of the filters that sparsify in bursts.
template <class Struct>
void add_burst(OptionTable<Struct>& table) {
  table
      .number(
          "theta_x", [](Struct& o) -> int& { return o.theta_x; }, {2, most_links},
          "Landmarks that keep their link to the robot in a burst, besides those in view. Alone it changes "
          "little: theta_max says when a burst is due [-].")
      .not_above("theta_max")
      .changeable()
      .number(
          "theta_max", [](Struct& o) -> int& { return o.theta_max; }, {2, most_links},
          "Links of the robot above which all but theta_x are dropped in one burst. More of them mean more "
          "links of the map and more work in an update [-].")
      .changeable();
}

template <class Struct>
void add_gates(OptionTable<Struct>& table) {
  table
      .number(
          "gate", [](Struct& o) -> double& { return o.gate; }, {.min = 0.0},
          "Ignores an observation of a known landmark whose squared normalised innovation is above this; "
          "0: never; 13.8 ignores one correct observation in a thousand [-].")
      .changeable()
      .number(
          "robust_above", [](Struct& o) -> double& { return o.robust_above; }, {.min = 0.0},
          "Gives less weight, Huber's, to an observation of a known landmark whose innovation is larger "
          "than this; 0: never; 3 is usual [sigma].")
      .changeable();
}

// Data association.

enum class Association { known, nearest, joint };

struct AssociationChoice {
  Association how = Association::known;
  AssociationOptions options;
  bool relocates = true;
};

const OptionTable<AssociationChoice>& association_table() {
  using Choice = AssociationChoice;
  static const OptionTable<Choice> table =
      OptionTable<Choice>()
          .choice(
              "association", [](Choice& c) -> Association& { return c.how; },
              OptionChoices<Association>{{"known", Association::known},
                                         {"nearest", Association::nearest},
                                         {"joint", Association::joint}},
              "Which landmark an observation is of. known: the one that the observation names; nearest: for "
              "each observation alone, the nearest compatible one; joint: the largest set of pairs that are "
              "compatible together. The last two ignore the names. Where observations bear no names, known "
              "means joint.")
          .without_names("joint")
          .number(
              "match_probability", [](Choice& c) -> double& { return c.options.match_probability; },
              {1e-12, 0.5}, "With an association: the probability that a correct pair is rejected [-].")
          .number(
              "new_probability", [](Choice& c) -> double& { return c.options.new_probability; }, {1e-15, 0.5},
              "With an association: the probability that an observation of a known landmark is taken for a "
              "new one [-].")
          .number(
              "admit_after", [](Choice& c) -> int& { return c.options.admit_after; }, {1, 1000},
              "With an association: scans that must see a landmark before it joins the map [-].")
          .number(
              "forget_after", [](Choice& c) -> int& { return c.options.forget_after; }, {1, 100'000},
              "With an association: scans without a sighting after which a landmark that has not joined the "
              "map is forgotten [-].")
          .number(
              "remove_below", [](Choice& c) -> double& { return c.options.remove_below; }, {0.0, 1.0},
              "With an association: removes a landmark that was seen in less than this share of the scans "
              "that should have seen it; 0: never [-].")
          .choice(
              "relocate", [](Choice& c) -> bool& { return c.relocates; },
              OptionChoices<bool>{{"when_lost", true}, {"never", false}},
              "Whether a filter that has lost its place looks for it in its map, and goes on from there.")
          .number(
              "wrong_place_probability",
              [](Choice& c) -> double& { return c.options.wrong_place_probability; }, {1e-30, 1.0},
              "With an association: acts on a place that it finds in its map if the probability that one as "
              "good "
              "is found by chance is below this [-].")
          .choice(
              "closings", [](Choice& c) -> bool& { return c.options.seeks_closings; },
              OptionChoices<bool>{{"sought", true}, {"within_gates", false}},
              "With an association, and relocate: when_lost: whether landmarks that have joined lately are "
              "sought among the older ones (sought), or only within the gates of single observations.");
  return table;
}

std::vector<OptionSpec> with_association(std::vector<OptionSpec> specs) {
  const std::vector<OptionSpec>& more = association_table().specs();
  specs.insert(specs.end(), more.begin(), more.end());
  return specs;
}

/// Adds to a filter what its options ask for: data association, and finding back.
template <class Filter, class Struct>
std::unique_ptr<Estimator> completed(const EstimatorSetup& setup, const Struct& filter_options,
                                     const Options& options) {
  AssociationChoice choice = association_table().read(options);
  choice.options.jointly = choice.how == Association::joint;
  auto filter = std::make_unique<Filter>(setup, filter_options);
  const bool relocates = choice.relocates && filter->local_belief() != nullptr;
  if (choice.how == Association::known) {
    if (!relocates) return filter;
    const auto make_local = [filter_options](const EstimatorSetup& local) {
      return std::make_unique<Filter>(local, filter_options);
    };
    return std::make_unique<RelocatingFilter>(std::move(filter), make_local, setup);
  }
  LocalMap::MakeFilter make_local;
  if (relocates) {
    make_local = [filter_options, associating = choice.options](const EstimatorSetup& local) {
      return std::make_unique<AssociatingFilter>(std::make_unique<Filter>(local, filter_options), local,
                                                 associating);
    };
  }
  return std::make_unique<AssociatingFilter>(std::move(filter), setup, choice.options, make_local);
}

/// An estimator whose filter is made from an options struct alone.
template <class Filter, class Struct>
EstimatorType type_of(std::string name, std::string help, const OptionTable<Struct>& table) {
  return {.name = std::move(name),
          .help = std::move(help),
          .options = table.specs(),
          .make = [table](const EstimatorSetup& setup, const Options& options) -> std::unique_ptr<Estimator> {
            return std::make_unique<Filter>(setup, table.read(options));
          }};
}

/// The same, with data association.
template <class Filter, class Struct>
EstimatorType associating_type_of(std::string name, std::string help, const OptionTable<Struct>& table) {
  return {.name = std::move(name),
          .help = std::move(help),
          .options = with_association(table.specs()),
          .make = [table](const EstimatorSetup& setup, const Options& options) {
            return completed<Filter>(setup, table.read(options), options);
          }};
}

// The report's filter and its relatives.

OptionTable<PlainSeifOptions> plain_seif_table(const PlainSeifOptions& defaults) {
  OptionTable<PlainSeifOptions> table(defaults);
  add_theta_x(table);
  table.choice(
      "drop", [](PlainSeifOptions& o) -> DropOrder& { return o.drop; },
      OptionChoices<DropOrder>{{"weakest_link", DropOrder::weakest_link},
                               {"weakest_out_of_view", DropOrder::weakest_out_of_view},
                               {"least_recently_seen", DropOrder::least_recently_seen}},
      "Which landmarks lose their link to the robot first. weakest_link follows the report to the "
      "letter, and breaks down where more than theta_x landmarks are in view.");
  return table;
}

EstimatorType seif_report() {
  OptionTable<PlainSeifOptions> table = plain_seif_table({});
  table
      .number(
          "K", [](PlainSeifOptions& o) -> int& { return o.random_landmarks; }, {0, 1'000'000},
          "Random landmarks that the mean recovery relaxes in each update, besides the active ones [-].")
      .changeable();
  return type_of<PlainSeif>(
      "seif_report",
      "The report's SEIF in constant time, faithful to its sparsification rule and so overconfident.", table);
}

/// A SEIF that sparsifies at once, as the report's filter does, and solves for its mean exactly.
EstimatorType seif_with_exact_mean(const std::string& name, const std::string& help,
                                   SparsificationRule rule) {
  return type_of<PlainSeif>(name, help,
                            plain_seif_table({.rule = rule, .mean_recovery = MeanRecovery::exact}));
}

EstimatorType seif_gauge_free() {
  OptionTable<PlainSeifOptions> table({.theta_max = SeifOptions{}.theta_max,
                                       .rule = SparsificationRule::gauge_free,
                                       .drop = DropOrder::least_recently_seen,
                                       .keep_in_view = true,
                                       .mean_recovery = MeanRecovery::exact});
  add_burst(table);
  return type_of<PlainSeif>(
      "seif_gauge_free",
      "The SEIF with gauge-free sparsification in bursts and exact mean: not in constant "
      "time. It shows what our rule alone costs.",
      table);
}

EstimatorType eseif() {
  OptionTable<EseifOptions> table;
  table
      .number(
          "theta_x", [](EseifOptions& o) -> int& { return o.theta_x; }, {2, most_links},
          "Links of the robot above which it is marginalised out and relocated [-].")
      .changeable()
      .number(
          "relocation_landmarks", [](EseifOptions& o) -> int& { return o.relocation_landmarks; }, {2, 1000},
          "Observations that are held back to relocate the robot from [-].");
  return type_of<Eseif>(
      "eseif",
      "The exactly sparse filter of Walter, Eustice and Leonard with exact mean: not in constant time.",
      table);
}

// Ours.

template <class Struct>
void add_linearisation(OptionTable<Struct>& table) {
  table
      .number(
          "first_estimates", [](Struct& o) -> int& { return o.first_estimates; }, {0, 1000},
          "Scans after which a landmark's first estimate is settled at the latest. First estimates fix what "
          "the filter cannot observe; 0: none [-].")
      .number(
          "relinearise_above", [](Struct& o) -> double& { return o.relinearise_above; }, {.min = 0.0},
          "Linearises an observation again after the update if its nonlinearity is above this [sigma].")
      .number(
          "linearisation_noise", [](Struct& o) -> double& { return o.linearisation_noise; },
          {.min = 0.0, .max = 100.0},
          "With the tree: what an observation lacks in linearity counts as noise, with this number of times "
          "its standard deviation; 0: not at all [-].")
      .number(
          "closing_gate", [](Struct& o) -> double& { return o.closing_gate; }, {.min = 0.0},
          "Linearises an observation at the measurement if the landmark is seen farther from its mean than "
          "this many times the measured range; 0: never [-].");
}

void add_mean_recovery(OptionTable<SeifOptions>& table) {
  table
      .choice(
          "mean_recovery", [](SeifOptions& o) -> MeanRecovery& { return o.mean_recovery; },
          OptionChoices<MeanRecovery>{{"tree", MeanRecovery::tree},
                                      {"multilevel", MeanRecovery::multilevel},
                                      {"exact", MeanRecovery::exact}},
          "How the mean is recovered. tree: with a condensation tree, exact in corridors and nearly so in "
          "areas; multilevel: by rigid groups, slow after a loop closure but in least memory; exact: by "
          "sparse Cholesky, not in constant time.")
      .number(
          "other_groups", [](SeifOptions& o) -> int& { return o.multilevel.other_groups; }, {0, 1000},
          "With multilevel: groups of each level that an update moves, besides those near the robot [-].")
      .number(
          "relaxed_groups", [](SeifOptions& o) -> int& { return o.multilevel.relaxed_groups; }, {0, 1000},
          "With multilevel: groups of about ten landmarks whose landmarks an update moves one by one [-].");
}

template <class Struct>
void add_tree(OptionTable<Struct>& table) {
  table
      .number(
          "tree_unknowns", [](Struct& o) -> int& { return o.tree.most_unknowns; }, {8, 1'000'000},
          "With the tree: unknowns at one node above which landmarks far from the robot move as groups, "
          "which turn and change their size [-].")
      .number(
          "tree_grain", [](Struct& o) -> double& { return o.tree.grain; }, {0.01, 100.0},
          "With the tree: distance from the robot over size of the coarsest groups [-].")
      .number(
          "tree_blocks", [](Struct& o) -> int& { return o.tree.most_blocks; }, {0, 1'000'000'000},
          "With the tree: blocks that an update may touch before it stops to prepare the next zone, or more "
          "if the robot would arrive before it is ready or a closure has bent the map; 0: all at once, so "
          "that no "
          "observation waits [-].")
      .choice(
          "tree_frames", [](Struct& o) -> bool& { return o.tree.turns; },
          OptionChoices<bool>{{"turning", true}, {"fixed", false}},
          "With the tree: whether what was learnt of a part of the map turns with that part when a closure "
          "turns "
          "it (turning), or stays as it was turned when it was learnt (fixed).");
}

EstimatorType seif() {
  OptionTable<SeifOptions> table;
  add_burst(table);
  add_linearisation(table);
  add_gates(table);
  add_mean_recovery(table);
  add_tree(table);
  return associating_type_of<Seif>("seif",
                                   "Ours: gauge-free sparsification, null space from first estimates, mean "
                                   "by a condensation tree. Its median "
                                   "update takes constant time.",
                                   table);
}

struct MultiSeifOptions : SeifOptions {
  TeamOptions team;
};

EstimatorType multi_seif() {
  using Struct = MultiSeifOptions;
  OptionTable<Struct> table;
  add_burst(table);
  add_linearisation(table);
  add_gates(table);
  add_tree(table);
  table
      .number(
          "tell_after", [](Struct& o) -> int& { return o.team.tell_after; }, {1, 100'000},
          "Updates after which the robot tells the others what it has learnt [-].")
      .number(
          "most_told", [](Struct& o) -> int& { return o.team.most_told; }, {2, 1000},
          "Landmarks of what is told at once. More are fewer bytes for each and more work for whoever learns "
          "it [-].")
      .number(
          "listen_after", [](Struct& o) -> int& { return o.team.listen_after; }, {1, 100'000},
          "Updates between two additions of what others have told [-].")
      .number(
          "most_learnt", [](Struct& o) -> int& { return o.team.most_learnt; }, {2, 100'000},
          "Landmarks of what is added at once [-].");
  return {
      .name = "multi_seif",
      .help =
          "A seif for a team: robots tell each other what they have learnt, and each has one map of all of "
          "it. Landmarks must bear names.",
      .options = table.specs(),
      .make = [table](const EstimatorSetup& setup, const Options& options) {
        const MultiSeifOptions chosen = table.read(options);
        return std::make_unique<TeamFilter>(std::make_unique<Seif>(setup, chosen), chosen.team);
      }};
}

EstimatorType ekf() {
  OptionTable<EkfOptions> table;
  add_gates(table);
  return associating_type_of<Ekf>(
      "ekf", "The dense extended Kalman filter: exact up to linearisation, quadratic time; the baseline.",
      table);
}

EstimatorType eif() {
  return {.name = "eif",
          .help = "The dense extended information filter: exact up to linearisation, cubic time; the oracle.",
          .options = {},
          .make = [](const EstimatorSetup& setup, const Options&) { return std::make_unique<Eif>(setup); }};
}

}  // namespace

Registry standard_estimators() {
  Registry registry;
  registry.add(ekf());
  registry.add(eif());
  registry.add(seif_report());
  registry.add(seif_with_exact_mean(
      "seif_exact",
      "The report's SEIF with its mean recovered exactly: not in constant time; the second row of its table.",
      SparsificationRule::report));
  registry.add(seif_with_exact_mean(
      "seif_modified",
      "The SEIF with Eustice's modified rule and exact mean: not in constant time; an oracle for consistent "
      "sparsification.",
      SparsificationRule::modified));
  registry.add(seif());
  registry.add(multi_seif());
  registry.add(seif_gauge_free());
  registry.add(eseif());
  return registry;
}

}  // namespace seif
