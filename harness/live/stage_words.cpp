#include <fmt/format.h>

#include <string>
#include <string_view>

#include "harness/live/stage_show.hpp"

namespace harness {

namespace {

std::string count_of(int number, std::string_view thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

StageWords covariance_words(seif::Stage stage, const StageFacts& facts) {
  if (stage == seif::Stage::motion)
    return {fmt::format(
                "The robot has moved {:.2f} m and turned {:.1f} deg by its odometry. The covariance of its "
                "pose grows, and its correlations with all landmarks are carried along.",
                facts.moved, facts.turned_deg),
            "Sigma = G Sigma G' + noise, with g of eqs. (26) and (29)"};
  return {
      fmt::format(
          "The robot has seen {}, {} of them new. The gain spreads the correction over every correlation: "
          "all landmarks become a little more certain, and all become correlated.",
          count_of(facts.seen, "landmark"), facts.fresh),
      "K = Sigma H' S^-1, with h of eqs. (15) and (23)"};
}

StageWords motion_words(const StageFacts& facts) {
  return {
      fmt::format(
          "The robot has moved {:.2f} m and turned {:.1f} deg by its odometry. What it knew of the active "
          "landmarks is passed on: each link to the robot weakens, and the active landmarks are linked to "
          "each other ({} new).",
          facts.moved, facts.turned_deg, count_of(facts.added, "link")),
      "Eq. (36), Lemma 3"};
}

StageWords measurement_words(const StageFacts& facts) {
  return {
      fmt::format(
          "The robot has seen {}, {} of them new. Each observation adds information to the robot, to that "
          "landmark, and to the link between them, and to nothing else ({} new).",
          count_of(facts.seen, "landmark"), facts.fresh, count_of(facts.added, "link")),
      "Eqs. (21), (22), Lemma 1"};
}

StageWords sparsification_words(std::string_view type, const StageFacts& facts) {
  const std::string equation = type == "seif" || type == "seif_gauge_free"
                                   ? "Eqs. (48) to (51), with the gauge-free rule in place of Y- = 0"
                                   : "Eqs. (46) to (51)";
  if (facts.removed == 0)
    return {"The robot has no more links than it may have: nothing is dropped.", equation};
  return {
      fmt::format(
          "The robot had too many links. {} removed. What they said goes into the links that stay, and into "
          "links between landmarks ({} new). The robot depends on few landmarks again.",
          facts.removed == 1 ? "One is" : count_of(facts.removed, "link") + " are", facts.added),
      equation};
}

StageWords recovery_words(std::string_view type) {
  if (type == "seif_report")
    return {
        "The matrix stays. The mean moves a step towards the solution of Omega mu = xi: only the active "
        "landmarks "
        "and a few others are adjusted.",
        "Eqs. (42), (43), Lemma 4"};
  return {"The matrix stays. The mean is recovered from it: the solution of Omega mu = xi.", "Eq. (37)"};
}

}  // namespace

StageWords words_for(seif::Stage stage, std::string_view type, seif::BeliefMatrix matrix,
                     const StageFacts& facts) {
  if (matrix != seif::BeliefMatrix::information) return covariance_words(stage, facts);
  switch (stage) {
    case seif::Stage::motion:
      return motion_words(facts);
    case seif::Stage::measurement:
      return measurement_words(facts);
    case seif::Stage::sparsification:
      return sparsification_words(type, facts);
    case seif::Stage::mean_recovery:
      break;
  }
  return recovery_words(type);
}

}  // namespace harness
