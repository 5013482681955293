#include "harness/live/live_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "harness/fixtures.hpp"
#include "live_test_session.hpp"

namespace harness {

namespace {

using nlohmann::json;
using test::LiveTestSession;
using test::ReceivedMessage;
using test::small_source;

constexpr std::uint64_t seeds[] = {1, 2, 3, 4, 5, 6};

constexpr double step_rate = 240.0;  // [Hz] of the small world

/// Lets it go on, step by step of the physics, until its time is `t` [s].
ReceivedMessage go_past(LiveTestSession& session, double t) {
  const double now = session.wait_for("frame").json.at("t");
  const auto steps = static_cast<std::int64_t>(std::ceil((t - now) * step_rate));
  session.ask({{"do", "step"}, {"count", steps}});
  return session.wait_for("frame", [&](const json& frame) {
    return frame.at("state") == "ended" || (frame.at("state") == "paused" && frame.at("t") >= t - 1e-9);
  });
}

json at(const std::string& what, json more = json::object()) {
  more["do"] = what;
  return more;
}

}  // namespace

TEST(LiveSession, ARunThatIsOnlyWatchedIsTheRunThatTheCommandMakes) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 1), false);
  session.wait_for_state("ended");
  const LiveTestSession::Saved saved = session.save();
  EXPECT_EQ(saved.hash, test::hash_of_run(folder / "small.yaml"));
  EXPECT_EQ(saved.hash_again, saved.hash);
}

TEST(LiveSession, EverythingThatIsDoneCanBeRunAgainToTheBit) {
  for (const std::uint64_t seed : seeds) {
    const TemporaryFolder folder;
    LiveTestSession session(small_source(folder, seed));
    go_past(session, 1.0);
    session.ask(at("drive", {{"v", 0.4}, {"omega", 0.7}}));
    go_past(session, 2.0);
    session.ask(at("step"));  // between two measurements
    session.ask(at("drive", {{"v", 0.3}, {"omega", -0.1}}));
    session.ask(at("release"));
    session.ask(at("option", {{"estimator", "seif"}, {"option", "theta_max"}, {"value", 8}}));
    session.ask(at("option", {{"estimator", "ekf"}, {"option", "odometry_sd_factor"}, {"value", 2.5}}));
    go_past(session, 3.0);
    session.ask(at("silence", {{"sensor", "landmark_sensor"}, {"on", true}}));
    session.ask(at("outlier", {{"size_sigma", 12.5}}));
    go_past(session, 4.0);
    session.ask(at("ice", {{"min", {-4, -4}}, {"max", {4, -2}}, {"friction", 0.02}}));
    session.ask(at("landmark", {{"x", 0.3}, {"y", 0.1}}));
    session.ask(at("wall", {{"points", {{-1.5, 1.5}, {1.5, 1.5}}}}));
    session.ask(at("silence", {{"sensor", "landmark_sensor"}, {"on", false}}));
    go_past(session, 5.0);
    session.ask(at("silence", {{"sensor", "encoders"}, {"on", true}}));
    go_past(session, 6.0);
    session.ask(at("silence", {{"sensor", "encoders"}, {"on", false}}));
    go_past(session, 7.0);
    const LiveTestSession::Saved saved = session.save();
    EXPECT_EQ(saved.hash_again, saved.hash) << "seed " << seed << '\n' << saved.world;
    for (const char* kind : {"ice", "landmark", "wall", "silence", "outlier", "option", "takeover"})
      EXPECT_NE(saved.world.find(kind), std::string::npos) << kind;
  }
}

TEST(LiveSession, AKidnappingCanBeRunAgainAndNothingTellsTheEstimators) {
  for (const std::uint64_t seed : seeds) {
    const TemporaryFolder folder;
    LiveTestSession session(small_source(folder, seed));
    go_past(session, 3.0);
    // Places without room are refused; one of these is free.
    json frame;
    for (const double x : {-5.5, -2.3, 0.4, 1.9, 5.3}) {
      session.ask(at("kidnap", {{"x", x}, {"y", 1.1}, {"heading_deg", 33.3}}));
      session.ask(at("step"));
      session.ask(at("step"));
      frame = session.wait_for("frame", [&](const json& f) { return f.at("state") == "paused"; }).json;
    }
    frame = go_past(session, 4.0).json;
    EXPECT_GT(frame.at("estimators").at(0).at("error_m").get<double>(), 1.0);
    const LiveTestSession::Saved saved = session.save();
    EXPECT_EQ(saved.hash_again, saved.hash) << "seed " << seed << '\n' << saved.world;
    EXPECT_NE(saved.world.find("kidnapping"), std::string::npos);
  }
}

TEST(LiveSession, GoesBackToAnEarlierMomentAndOnToTheSameBits) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 2));
  go_past(session, 1.0);
  session.ask(at("drive", {{"v", 0.5}, {"omega", 0.2}}));
  go_past(session, 6.0);
  const std::string before = session.save().hash;
  session.ask(at("back", {{"t", 3.0}}));
  const json frame =
      session.wait_for("frame", [](const json& f) { return f.at("epoch") == 2 && f.at("state") == "paused"; })
          .json;
  EXPECT_NEAR(frame.at("t").get<double>(), 3.0, 1e-9);
  go_past(session, 6.0);
  EXPECT_EQ(session.save().hash, before);
}

TEST(LiveSession, AnInterventionInThePastTakesThePlaceOfWhatCameLater) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 3));
  go_past(session, 2.0);
  session.ask(at("outlier", {{"size_sigma", 30}}));
  go_past(session, 4.0);
  session.ask(at("back", {{"t", 1.0}}));
  session.wait_for("frame", [](const json& f) { return f.at("epoch") == 2 && f.at("state") == "paused"; });
  session.ask(at("drive", {{"v", 0.2}, {"omega", 0.5}}));
  go_past(session, 4.0);
  const LiveTestSession::Saved saved = session.save();
  EXPECT_EQ(saved.world.find("outlier"), std::string::npos);
  EXPECT_NE(saved.world.find("takeover"), std::string::npos);
  EXPECT_EQ(saved.hash_again, saved.hash);
}

TEST(LiveSession, ShowsTheStagesOfAnUpdateOneByOne) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 1));
  go_past(session, 4.0);
  std::vector<std::string> stages;
  for (int i = 0; i < 8; ++i) {
    session.ask(at("stage"));
    const ReceivedMessage stage = session.wait_for("stage");
    stages.push_back(stage.json.at("stage"));
    EXPECT_EQ(stage.json.at("estimator"), "seif");
    EXPECT_FALSE(stage.json.at("sentence").get<std::string>().empty());
    EXPECT_NE(stage.json.at("equation").get<std::string>().find('('), std::string::npos);
    const std::size_t rows = stage.json.at("ids").size() + 1;
    EXPECT_EQ(stage.floats("before").size(), rows * rows);
    EXPECT_EQ(stage.floats("after").size(), rows * rows);
    EXPECT_TRUE(stage.json.at("whole"));
    const std::size_t n = 3 + 2 * (rows - 1);
    EXPECT_EQ(stage.floats("values_after").size(), n * n);
    session.wait_for_state("stage");
  }
  const std::vector<std::string> once = {"motion", "measurement", "sparsification", "mean_recovery"};
  EXPECT_EQ(std::vector(stages.begin(), stages.begin() + 4), once);
  EXPECT_EQ(std::vector(stages.begin() + 4, stages.end()), once);
  // What is asked for in the middle of an update is done after it.
  session.ask(at("stage"));
  session.wait_for("stage");
  session.ask(at("drive", {{"v", 0.1}, {"omega", 0.0}}));
  session.ask(at("update"));
  session.wait_for("frame", [](const json& f) { return f.at("state") == "paused" && f.at("hand"); });
  go_past(session, 8.0);
  const LiveTestSession::Saved saved = session.save();
  EXPECT_EQ(saved.hash_again, saved.hash);
}

/// Whoever waits in the middle of an update does not make it slower.
TEST(LiveSession, TheTimeOfAnUpdateIsNotThatOfItsWatcher) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 1));
  go_past(session, 2.0);
  for (int i = 0; i < 4; ++i) {
    session.ask(at("stage"));
    session.wait_for("stage");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  session.ask(at("update"));
  const json frame = session.wait_for_state("paused").json;
  EXPECT_LT(frame.at("estimators").at(0).at("update_us").get<double>(), 250'000.0);
}

TEST(LiveSession, IsSavedAgainAndAgain) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 5));
  std::string last;
  for (const double t : {1.0, 2.0, 2.5}) {
    go_past(session, t);
    const LiveTestSession::Saved saved = session.save();
    EXPECT_EQ(saved.hash_again, saved.hash);
    EXPECT_NE(saved.hash, last);
    last = saved.hash;
  }
}

TEST(LiveSession, RunsACopyOfAnEstimatorWithAnotherOptionBesideIt) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 4));
  go_past(session, 3.0);
  session.ask(at("beside", {{"estimator", "seif"}, {"option", "mean_recovery"}, {"value", "exact"}}));
  const json hello = session.wait_for("hello", [](const json& h) { return h.at("epoch") == 2; }).json;
  ASSERT_EQ(hello.at("estimators").size(), 3U);
  EXPECT_EQ(hello.at("estimators").at(2).at("name"), "seif_mean_recovery");
  EXPECT_NE(hello.at("estimators").at(2).at("colour"), hello.at("estimators").at(0).at("colour"));
  const json frame = session.wait_for("frame", [](const json& f) { return f.at("state") == "paused"; }).json;
  EXPECT_NEAR(frame.at("t").get<double>(), 3.0, 1e-6);
  const LiveTestSession::Saved saved = session.save();
  EXPECT_EQ(saved.hash_again, saved.hash) << saved.world;
}

TEST(LiveSession, RefusesWhatCannotBeDoneAndSaysWhy) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 1));
  EXPECT_EQ(session.refusal(at("save", {{"what", "run"}})), "there is nothing to save before the first scan");
  go_past(session, 1.0);
  EXPECT_NE(session.refusal(at("kidnap", {{"x", 900}, {"y", 0}, {"heading_deg", 0}})).find("no room"),
            std::string::npos);
  EXPECT_NE(session.refusal(at("option", {{"estimator", "seif"}, {"option", "theta_x"}, {"value", 40}}))
                .find("theta_max"),
            std::string::npos);
  EXPECT_NE(session.refusal(at("option", {{"estimator", "seif"}, {"option", "tree_grain"}, {"value", 2}}))
                .find("cannot change during a run"),
            std::string::npos);
  EXPECT_NE(session.refusal(at("option", {{"estimator", "none"}, {"option", "theta_x"}, {"value", 2}}))
                .find("there is no estimator"),
            std::string::npos);
  EXPECT_NE(session.refusal(at("beside", {{"estimator", "seif"}, {"option", "theta_x"}, {"value", "much"}}))
                .find("theta_x"),
            std::string::npos);
  EXPECT_NE(session.refusal(at("inspect", {{"estimator", "seif"}, {"id", 99}})).find("not in the map"),
            std::string::npos);
  EXPECT_NE(session.refusal(at("fly")).find("unknown"), std::string::npos);
  // Nothing of this has left a trace.
  go_past(session, 3.0);
  const LiveTestSession::Saved saved = session.save();
  EXPECT_EQ(saved.hash_again, saved.hash);
  EXPECT_EQ(saved.world.find("kidnapping"), std::string::npos);
}

TEST(LiveSession, TellsAboutALandmark) {
  const TemporaryFolder folder;
  LiveTestSession session(small_source(folder, 1));
  session.ask(at("update"));
  const ReceivedMessage frame = session.wait_for("frame", [](const json& f) {
    for (const json& array : f.at("arrays")) {
      if (array.at(0) == "ids0" && array.at(2) > 0) return true;
    }
    return false;
  });
  const std::uint32_t id = frame.numbers("ids0").front();
  go_past(session, 3.0);
  session.ask(at("inspect", {{"estimator", "seif"}, {"id", id}}));
  const json landmark = session.wait_for("landmark").json;
  EXPECT_EQ(landmark.at("id"), id);
  EXPECT_GT(landmark.at("seen"), 0);
  EXPECT_GE(landmark.at("nees").get<double>(), 0.0);
  EXPECT_FALSE(landmark.at("links").empty());
  EXPECT_FALSE(landmark.at("observations").empty());
  EXPECT_LE(landmark.at("observations").size(), 8U);
}

}  // namespace harness
