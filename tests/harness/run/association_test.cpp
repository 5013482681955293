// Runs in which observations name no landmark: recorded, replayed and scored.

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "harness/score/details.hpp"
#include "harness/score/scoreboard.hpp"
#include "harness/score/summary.hpp"
#include "harness/score/true_names.hpp"

namespace harness {
namespace {

using test::choice;
using test::read_file;
using test::replay;
using test::run_live;
using test::small_world;
using test::write_file;

worlds::World nameless_world() {
  worlds::World world = small_world();
  world.duration = 60.0;  // a round and a half
  world.landmark_sensor.ids = worlds::LandmarkIds::hidden;
  world.landmark_sensor.false_detections = 0.2;
  world.estimators = {choice("ekf"), choice("seif")};
  for (worlds::EstimatorChoice& estimator : world.estimators)
    estimator.options["association"] = std::string("joint");
  return world;
}

TEST(TrueNames, GoWithTheMajority) {
  TrueNames names;
  ScanEvent event;
  event.scan.observations.resize(3);
  event.true_ids = {7, 8, 9};
  names.add(std::vector<seif::LandmarkId>{0, 1, seif::no_landmark}, event);
  names.add(0, 7);
  names.add(0, 8);
  names.add(1, seif::no_landmark);
  names.add(1, seif::no_landmark);
  EXPECT_EQ(names.of(0), 7);
  EXPECT_EQ(names.right(0), 2);
  EXPECT_EQ(names.of(1), seif::no_landmark) << "mostly false detections";
  EXPECT_EQ(names.of(5), seif::no_landmark) << "never given";
  EXPECT_EQ(names.right(), 2);
}

TEST(TrueNames, AreThoseThatTheObservationsBearIfNoOthersAreRecorded) {
  TrueNames names;
  ScanEvent event;
  event.scan.observations = {{.landmark = 7}, {.landmark = seif::no_landmark}};
  names.add(std::vector<seif::LandmarkId>{0, 1}, event);
  EXPECT_EQ(names.of(0), 7);
  EXPECT_EQ(names.of(1), seif::no_landmark);
  EXPECT_EQ(names.right(), 1);
}

TEST(TrueNames, OfTwoThatAreOneThatWithMoreRightObservationsCounts) {
  TrueNames names;
  names.add(0, 7);
  for (int i = 0; i < 3; ++i) names.add(1, 7);
  names.add(2, 4);
  names.add(3, seif::no_landmark);
  const std::vector<MapRecord> map = {{0, {1, 0}, {}}, {1, {2, 0}, {}}, {2, {3, 0}, {}}, {3, {4, 0}, {}}};
  const ScoredMap scored = score_names(map, names);
  EXPECT_EQ(scored.duplicates, 1);
  ASSERT_EQ(scored.landmarks.size(), 3U);
  EXPECT_EQ(scored.landmarks[0].landmark, 7);
  EXPECT_EQ(scored.landmarks[0].mean.x(), 2.0);
  EXPECT_EQ(scored.landmarks[1].landmark, 4);
  EXPECT_EQ(scored.landmarks[2].landmark, seif::no_landmark);
}

TEST(ReadAssociations, CountsRowByRow) {
  const TemporaryFolder folder;
  write_file(folder / "observations.csv",
             "t,landmark,range,bearing\n1,,2,0\n1,,3,0\n2,,,\n3,,2,0\n3,,5,0\n4,,5,0\n");
  write_file(folder / "observations_true_ids.csv", "t,true_landmark\n1,7\n1,8\n2,\n3,7\n3,\n4,1\n");
  write_file(folder / "seif_associations.csv", "t,landmark\n1,0\n1,\n2,\n3,0\n3,0\n");
  const Associations associations = read_associations(folder.path(), "seif").value();
  EXPECT_EQ(associations.named, 3);
  EXPECT_EQ(associations.left_out, 1) << "an empty scan leaves nothing out, and the filter failed before 4 s";
  EXPECT_EQ(associations.names->right(), 2);
  EXPECT_FALSE(read_associations(folder.path(), "ekf"));
  write_file(folder / "seif_associations.csv", "t,landmark\n1,0\n1,\n2,\n3,0\n3,0\n4,0\n5,0\n");
  EXPECT_THROW(read_associations(folder.path(), "seif"), BadInput);
}

TEST(ReadAssociations, TakesTheNamesThatTheObservationsBear) {
  const TemporaryFolder folder;
  write_file(folder / "observations.csv", "t,landmark,range,bearing\n1,7,2,0\n1,8,3,0\n2,,,\n3,7,2,0\n");
  write_file(folder / "seif_associations.csv", "t,landmark\n1,0\n1,\n2,\n3,0\n");
  EXPECT_EQ(read_associations(folder.path(), "seif")->names.value().right(0), 2);
  write_file(folder / "observations.csv", "t,landmark,range,bearing\n1,,2,0\n1,,3,0\n2,,,\n3,,2,0\n");
  EXPECT_FALSE(read_associations(folder.path(), "seif")->names);
}

// The filter's own names 0, 1, 2, .. are also ids of the world, but of other landmarks.
TEST(NamedRun, OfAFilterWithNamesOfItsOwnIsScoredByTheNamesThatTheObservationsBear) {
  const TemporaryFolder folder;
  worlds::World world = nameless_world();
  world.landmark_sensor.ids = worlds::LandmarkIds::known;
  world.landmark_sensor.false_detections = 0.0;
  const RunResult run = run_live(world, folder / "run");
  ASSERT_EQ(exit_code(run), 0) << run.error;
  ASSERT_FALSE(std::filesystem::exists(folder / "run" / "observations_true_ids.csv"));
  for (const EstimatorScore& score : run.summary.score.estimators) {
    EXPECT_LT(score.landmarks.rmse_aligned.value(), 0.05) << score.name;
    EXPECT_EQ(score.associations_right, 1.0) << score.name;
    EXPECT_LT(score.nees_landmark_final.value(), 5.0) << score.name;
  }
}

TEST(NamelessRun, IsScoredByWhatTheLandmarksTrulyAre) {
  const TemporaryFolder folder;
  const RunResult run = run_live(nameless_world(), folder / "run");
  ASSERT_EQ(exit_code(run), 0) << run.error;
  const std::vector<std::string> names = {"ekf", "seif"};
  const RunDetails details = score_details(folder / "run", names, {});
  for (std::size_t i = 0; i < 2; ++i) {
    const EstimatorScore& score = run.summary.score.estimators[i];
    EXPECT_EQ(score.landmarks_mapped, 12) << score.name;
    EXPECT_EQ(score.landmarks_spurious, 0) << score.name;
    EXPECT_LT(*score.landmarks.rmse_aligned, 0.05) << score.name;
    EXPECT_GT(*score.associations_right, 0.99) << score.name;
    EXPECT_LT(*score.associations_left_out, 0.1) << score.name;
    EXPECT_TRUE(score.nees_landmark_final) << "landmarks are found in the world";
    EXPECT_EQ(details.estimators[i].map->missed, 0);
    EXPECT_EQ(details.estimators[i].map->duplicate, 0);
  }
  const auto summary = nlohmann::json::parse(read_file(folder / "run" / "summary.json"));
  EXPECT_GT(summary["estimators"]["seif"]["associations_right"], 0.99);
}

// As a log that somebody else has written: nobody recorded what the observations truly are.
TEST(NamelessRun, WithoutTrueIdsIsScoredByPlace) {
  const TemporaryFolder folder;
  const worlds::World world = nameless_world();
  const RunResult voted = run_live(world, folder / "run");
  std::filesystem::remove(folder / "run" / "observations_true_ids.csv");
  const RunResult placed = replay(world, folder / "run", folder / "replay");
  const RunDetails details = score_details(folder / "replay", std::vector<std::string>{"ekf", "seif"}, {});
  for (std::size_t i = 0; i < 2; ++i) {
    const EstimatorScore& score = placed.summary.score.estimators[i];
    EXPECT_EQ(score.matched_by, MatchedBy::place);
    EXPECT_EQ(score.landmarks.rmse, voted.summary.score.estimators[i].landmarks.rmse) << score.name;
    EXPECT_EQ(score.landmarks_spurious, 0) << score.name;
    ASSERT_TRUE(score.by_place);
    EXPECT_EQ(score.by_place->missed, 0) << score.name;
    EXPECT_EQ(details.estimators[i].map->missed, 0) << score.name;
    EXPECT_FALSE(score.associations_right);
    EXPECT_FALSE(score.nees_landmark) << "what is near by definition has no NEES";
    EXPECT_FALSE(details.estimators[i].landmarks_inside);
  }
  const auto summary = nlohmann::json::parse(read_file(folder / "replay" / "summary.json"));
  EXPECT_EQ(summary["estimators"]["seif"]["landmarks_matched_by"], "place");
  EXPECT_EQ(summary["estimators"]["seif"]["landmarks_missed"], 0);
  EXPECT_NE(scoreboard(placed.summary).find("* Landmarks of seif matched by place: 12 matched, 0 missed"),
            std::string::npos)
      << scoreboard(placed.summary);
}

TEST(NamelessRun, WhoseMapFitsNowhereHasNoScoreOfIt) {
  const TemporaryFolder folder;
  const worlds::World world = nameless_world();
  run_live(world, folder / "run");
  for (const char* file : {"observations_true_ids.csv", "truth.csv"})
    std::filesystem::remove(folder / "run" / file);
  write_file(folder / "run" / "landmarks.csv", "landmark,x,y\n0,0,0\n1,100,0\n2,0,150\n");
  const RunResult run = replay(world, folder / "run", folder / "replay");
  for (const EstimatorScore& score : run.summary.score.estimators) {
    EXPECT_EQ(score.matched_by, MatchedBy::nothing);
    EXPECT_GT(score.landmarks_mapped, 10);
    EXPECT_FALSE(score.landmarks.rmse || score.landmarks.rmse_aligned || score.landmarks_spurious);
  }
  EXPECT_NE(scoreboard(run.summary).find("The map of seif has no score"), std::string::npos);
}

std::string line_of(const std::string& text, const std::string& beginning) {
  const std::size_t at = text.find("\n" + beginning);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

TEST(NamelessRun, IsLeftToTheEstimatorsThatCanAssociate) {
  const TemporaryFolder folder;
  worlds::World world = nameless_world();
  world.duration = 10.0;
  world.estimators = {choice("ekf"), choice("seif_report"), choice("eif"), choice("seif")};
  world.estimators.back().options["association"] = std::string("nearest");
  const RunResult run = run_live(world, folder / "run");
  ASSERT_EQ(run.summary.score.estimators.size(), 2U);
  EXPECT_EQ(run.summary.score.estimators[0].name, "ekf");
  EXPECT_EQ(run.summary.score.estimators[1].name, "seif");
  const std::vector<std::string> notes = {
      "ekf ran with association: joint, because the observations do not name their landmarks",
      "seif_report was left out: the observations do not name their landmarks",
      "eif was left out: the observations do not name their landmarks"};
  EXPECT_EQ(run.summary.notes, notes);
  EXPECT_EQ(read_summary(folder / "run" / "summary.json").notes, notes);
  for (const std::string& note : notes) EXPECT_EQ(line_of(scoreboard(run.summary), note), note);
  const RunResult replayed = replay(world, folder / "run", folder / "replay");
  EXPECT_EQ(replayed.summary.notes, notes);
  EXPECT_EQ(replayed.summary.trajectory_hash, run.summary.trajectory_hash);
}

TEST(NamelessRun, SaysWhatToTypeIfNoEstimatorIsLeft) {
  const TemporaryFolder folder;
  worlds::World world = nameless_world();
  world.estimators = {choice("seif_report")};
  try {
    run_live(world, folder / "run");
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_TRUE(std::string(error.what()).ends_with("; type --set 'estimators={ekf: {}, seif: {}}'"))
        << error.what();
  }
  world.estimators = {choice("ekf"), choice("seif_report")};
  world.drive.pose_from = "seif_report";
  EXPECT_THROW(run_live(world, folder / "run"), BadInput);
}

TEST(NamelessRun, IsReplayedToTheSameBytes) {
  const TemporaryFolder folder;
  const worlds::World world = nameless_world();
  const RunResult live = run_live(world, folder / "live");
  const RunResult replayed = replay(world, folder / "live", folder / "replay");
  EXPECT_EQ(replayed.summary.trajectory_hash, live.summary.trajectory_hash);
  for (const char* file : {"log.yaml", "observations.csv", "observations_true_ids.csv",
                           "ekf_associations.csv", "seif_associations.csv", "seif_map.csv"})
    EXPECT_EQ(read_file(folder / "replay" / file), read_file(folder / "live" / file)) << file;
}

// The ids that the sensor reads are not used, so wrong ones do no harm.
TEST(NamelessRun, AnAssociationDoesNotBelieveWhatIsMisread) {
  const TemporaryFolder folder;
  worlds::World world = nameless_world();
  world.landmark_sensor.ids = worlds::LandmarkIds::known;
  world.landmark_sensor.misread_probability = 0.3;
  const RunResult run = run_live(world, folder / "run");
  for (const EstimatorScore& score : run.summary.score.estimators) {
    EXPECT_EQ(score.landmarks_mapped, 12) << score.name;
    EXPECT_GT(*score.associations_right, 0.99) << score.name;
  }
}

}  // namespace
}  // namespace harness
