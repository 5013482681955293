// `seifbed live` as people use it: through its page in a real browser, and through its socket.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "browser_page.hpp"
#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"
#include "harness/report/browser.hpp"
#include "harness/web/page_client.hpp"
#include "live_program.hpp"

namespace harness {

namespace {

using nlohmann::json;
using test::BrowserPage;
using test::LiveProgram;
using test::PageClient;

/// A walled square with twelve landmarks, for 30 s.
void write_small_world(const TemporaryFolder& folder) {
  test::write_file(folder / "small.yaml", R"(name: small
duration_s: 30
ground: {size_m: [16, 16]}
robot: {start: {x_m: -3, y_m: -3}}
landmarks: {generators: [{type: poisson_disk, count: 12, distance_m: 1.8, region: {min_m: [-6, -6], max_m: [6, 6]}}]}
obstacles: {walls: [{points_m: [[-7, -7], [7, -7], [7, 7], [-7, 7]], closed: true}]}
drive: {mode: loop, waypoints_m: [[-3, -3], [3, -3], [3, 3], [-3, 3]]}
estimators: {seif: {theta_x: 3, theta_max: 5}, ekf: {}}
)");
}

std::string hash_in(const std::filesystem::path& run) {
  return json::parse(test::read_file(run / "summary.json")).at("trajectory_hash");
}

/// Where a point of the ground is on the page. [px]
std::pair<double, double> on_page(BrowserPage& page, double x, double y) {
  const json place = page.evaluate(fmt::format(R"((() => {{
    const p = new THREE.Vector3({}, {}, 0).project(seifbed.view.camera);
    const box = document.getElementById("scene").getBoundingClientRect();
    return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height];
  }})())",
                                               x, y));
  return {place.at(0), place.at(1)};
}

void drag_on_ground(BrowserPage& page, double from_x, double from_y, double to_x, double to_y) {
  const auto from = on_page(page, from_x, from_y);
  const auto to = on_page(page, to_x, to_y);
  page.drag(from.first, from.second, to.first, to.second);
}

#define NEEDS_BROWSER(folder, browser)                                           \
  const std::optional<std::string> found_##browser = test::find_browser(folder); \
  if (!found_##browser) GTEST_SKIP() << "no Chromium is installed";              \
  const std::string& browser = *found_##browser

}  // namespace

TEST(LiveCommand, WhatIsDoneInABrowserCanBeRunAgain) {
  const TemporaryFolder folder;
  NEEDS_BROWSER(folder, browser);
  write_small_world(folder);
  // The run must not end before a slow browser has stopped it.
  LiveProgram program(folder, "live small.yaml --set duration_s=86400 --speed 4 --no-browser");
  BrowserPage page(folder, browser, program.url());
  page.wait_until("seifbed.state.firstPicture && seifbed.state.frame.updates > 3");
  page.press(" ");
  page.wait_until("seifbed.state.state == 'paused'");
  for (const char* stage : {"motion", "measurement", "sparsification", "mean_recovery"}) {
    page.press("s");
    page.wait_until(fmt::format("seifbed.state.stage && seifbed.state.stage.stage == '{}'", stage));
  }
  EXPECT_NE(page.evaluate("document.getElementById('sentence').textContent").get<std::string>().find("mean"),
            std::string::npos);
  page.press("u");
  page.wait_until("seifbed.state.state == 'paused'");

  page.evaluate("document.getElementById('hands-part').open = true");
  page.evaluate(
      "document.getElementById('which').value = 'theta_x'; document.getElementById('which').onchange();"
      "document.getElementById('what').value = '2'; document.getElementById('change').click()");
  page.wait_until("seifbed.state.said && seifbed.state.said.text.includes('theta_x is 2')");
  page.evaluate("document.querySelector('[data-mode=kidnap]').click()");
  drag_on_ground(page, -3, -3, 0.2, 0.1);
  page.press("Escape");
  page.press("n");
  page.press("n");
  page.wait_until("Math.abs(seifbed.state.frame.truth[0] - 0.2) < 0.2");
  page.evaluate("document.querySelector('[data-mode=wall]').click()");
  drag_on_ground(page, -1, 2, 1, 2.5);
  page.press("Escape");
  page.press(" ");
  page.wait_until("seifbed.state.t > 8");
  page.press(" ");
  page.evaluate("document.querySelector('[data-save=run]').click()");
  page.wait_until("seifbed.state.saved");
  EXPECT_EQ(page.evaluate("seifbed.state.saved.path"), "runs/small-live");

  const test::Called again = test::call(folder, "run runs/small-live/world.yaml --out again --quiet");
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(hash_in(folder / "again"), hash_in(folder / "runs/small-live"));
  const std::string world = test::read_file(folder / "runs/small-live/world.yaml");
  for (const char* what : {"kidnapping", "kind: wall", "theta_x"})
    EXPECT_NE(world.find(what), std::string::npos);
  // Reports and films show what was done, too.
  const test::Called report = test::call(folder, "report runs/small-live --out report.html");
  EXPECT_EQ(report.exit_code, 0) << report.errors;
  EXPECT_NE(test::read_file(folder / "report.html").find("another option (seif: theta_x = 2)"),
            std::string::npos);
  const test::Called still = test::call(folder, "film runs/small-live --at 8 --out still.png --quiet");
  EXPECT_EQ(still.exit_code, 0) << still.errors;
  EXPECT_EQ(program.stop(), 0);
}

TEST(LiveCommand, APageOfWhatWasSeenPlaysWithoutTheProgram) {
  const TemporaryFolder folder;
  NEEDS_BROWSER(folder, browser);
  write_small_world(folder);
  {
    LiveProgram program(folder, "live small.yaml --speed 4 --no-browser");
    BrowserPage page(folder, browser, program.url());
    page.wait_until("seifbed.state.firstPicture && seifbed.state.t > 6");
    test::write_file(folder / "seen.html", page.evaluate("seifbed.page()"));
  }
  BrowserPage page(folder, browser, "file://" + (folder / "seen.html").string());
  page.wait_until("seifbed.state.recorded && seifbed.state.frames > 0 && seifbed.state.firstPicture");
  page.evaluate("seifbed.player.seek(1e6)");
  page.wait_until("seifbed.state.t > 5 && seifbed.state.beliefs[0].ids.length > 3");
}

TEST(LiveCommand, NothingOverlapsOnAPhone) {
  const TemporaryFolder folder;
  NEEDS_BROWSER(folder, browser);
  write_small_world(folder);
  LiveProgram program(folder, "live small.yaml --speed 4 --no-browser");
  BrowserPage page(folder, browser, program.url(), {390, 844, true});
  page.wait_until("seifbed.state.firstPicture && seifbed.state.t > 2");
  page.evaluate("document.querySelectorAll('details').forEach((part) => { part.open = true; })");
  EXPECT_EQ(page.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), true);
  // No two texts or controls cover each other; what scrolls by itself is left out.
  EXPECT_EQ(page.evaluate(R"((() => {
    const all = [...document.querySelectorAll("#panel button, #panel summary, #panel label, #panel p, #controls button, #controls label, header h1, header p")]
      .filter((node) => node.offsetParent !== null && !node.closest(".scroll") && node.textContent.trim() !== "");
    const bad = [];
    for (const a of all) for (const b of all) {
      if (a === b || a.contains(b) || b.contains(a) || a.closest("#controls") !== b.closest("#controls")) continue;
      const p = a.getBoundingClientRect(), q = b.getBoundingClientRect();
      const x = Math.min(p.right, q.right) - Math.max(p.left, q.left), y = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
      if (x > 1 && y > 1) bad.push(a.textContent.trim() + " / " + b.textContent.trim());
    }
    return bad;
  })())"),
            json::array());
}

TEST(LiveCommand, PagesThatComeAndGoSendRubbishOrNeverReadDoNotStopTheRun) {
  const TemporaryFolder folder;
  write_small_world(folder);
  LiveProgram program(folder, "live small.yaml --speed max --no-browser");
  const PageClient lazy(program.port(), program.socket());
  for (int i = 0; i < 20; ++i) {
    PageClient page(program.port(), program.socket());
    page.wait_for("hello");
    for (const char* rubbish : {"", "{", "[1,2,3]", "{\"do\":\"fly\"}", "{\"do\":\"back\",\"t\":\"x\"}"})
      page.send(rubbish);
    page.send(R"({"do":"view","min":[-8,-8],"max":[8,8],"matrix":true,"links":true,"seq":1})");
    page.wait_for("frame");
    if (i % 2 == 0) page.drop();
  }
  PageClient last(program.port(), program.socket());
  const double before = last.wait_for("frame").json.at("t");
  last.send(R"({"do":"go"})");
  last.wait_for("frame", [&](const json& frame) { return frame.at("t") > before; });
  EXPECT_TRUE(program.is_running());
  EXPECT_EQ(program.stop(), 0);
}

TEST(LiveCommand, WhoeverLooksAtARunChangesNoBitOfIt) {
  const TemporaryFolder folder;
  write_small_world(folder);
  const test::Called plain = test::call(folder, "run small.yaml --out plain --quiet");
  ASSERT_EQ(plain.exit_code, 0) << plain.errors;
  LiveProgram program(folder, "run small.yaml --out watched --live --quiet");
  {
    std::vector<PageClient> pages;
    try {
      for (int i = 0; i < 5; ++i) {
        pages.emplace_back(program.port(), program.socket());
        pages.back().send(R"({"do":"kidnap","x":0,"y":0,"heading_deg":0,"seq":1})");
        pages.back().send(R"({"do":"view","min":[-8,-8],"max":[8,8],"matrix":true,"links":true,"seq":2})");
      }
    } catch (const std::exception&) {  // a fast machine is through already
    }
    EXPECT_EQ(program.wait(), 0);
  }
  EXPECT_EQ(hash_in(folder / "watched"), hash_in(folder / "plain"));
}

TEST(LiveCommand, ARecordedRunIsSteppedAndTakenBackAndItsWorldStaysAsItIs) {
  const TemporaryFolder folder;
  write_small_world(folder);
  ASSERT_EQ(test::call(folder, "run small.yaml --out run --quiet").exit_code, 0);
  LiveProgram program(folder, "live run --paused --no-browser");
  PageClient page(program.port(), program.socket());
  const json hello = page.wait_for("hello").json;
  EXPECT_EQ(hello.at("source"), "log");
  EXPECT_EQ(hello.at("can").at("kidnap"), false);
  page.send(R"({"do":"kidnap","x":0,"y":0,"heading_deg":0,"seq":1})");
  EXPECT_EQ(page.wait_for("said").json.at("text"), "this is a recorded log: its world cannot be changed");
  page.send(R"({"do":"update","count":20,"seq":2})");
  page.wait_for("frame",
                [](const json& frame) { return frame.at("updates") >= 20 && frame.at("state") == "paused"; });
  page.send(R"({"do":"back","t":1.0,"seq":3})");
  page.wait_for("frame",
                [](const json& frame) { return frame.at("epoch") == 2 && frame.at("state") == "paused"; });
  page.send(R"({"do":"beside","estimator":"seif","option":"theta_x","value":2,"seq":4})");
  EXPECT_EQ(page.wait_for("hello").json.at("estimators").size(), 3U);
}

TEST(LiveCommand, SaysWhatIsWrongWithACall) {
  const TemporaryFolder folder;
  write_small_world(folder);
  const auto errors_of = [&](const std::string& arguments, int code) {
    const test::Called called = test::call(folder, arguments);
    EXPECT_EQ(called.exit_code, code) << called.errors;
    return called.errors;
  };
  EXPECT_NE(errors_of("live nowhere.yaml", 2).find("nowhere.yaml"), std::string::npos);
  EXPECT_NE(errors_of("live small.yaml --speed fast", 2).find("--speed must be a number"), std::string::npos);
  EXPECT_NE(errors_of("live small.yaml --bind 203.0.113.7", 1).find("cannot listen at 203.0.113.7"),
            std::string::npos);
  EXPECT_NE(errors_of("live small.yaml --bind everywhere", 1).find("cannot listen at everywhere"),
            std::string::npos);
  EXPECT_NE(errors_of("live small.yaml --set drive.speed_m_s=fast", 2).find("speed_m_s"), std::string::npos);
}

}  // namespace harness
