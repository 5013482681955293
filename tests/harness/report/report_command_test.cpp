// `seifbed report` on the command line, and its pages in a browser.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "browser.hpp"
#include "harness/command_call.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

using test::call;
using test::Called;
using test::read_file;

class ReportCommand : public testing::Test {
 protected:
  ReportCommand() {
    test::write_file(folder / "world.yaml",
                     "name: \"<b>small & 'bold'</b>\"\n"
                     "duration_s: 20\n"
                     "physics: {engine: kinematic}\n"
                     "landmarks: {generators: [{type: uniform, count: 20}]}\n"
                     "drive: {mode: loop, waypoints_m: [[3, 3], [-3, 3], [-3, -3], [3, -3]]}\n"
                     "estimators: {ekf: {}, seif_report: {}}\n");
  }

  void run() { ASSERT_EQ(call(folder, "run world.yaml --out run --quiet").exit_code, 0); }

  void report(const std::string& arguments) {
    const Called called = call(folder, "report " + arguments);
    ASSERT_EQ(called.exit_code, 0) << called.errors;
  }

  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder;
};

TEST_F(ReportCommand, WritesAPageOfARun) {
  run();
  test::write_file(folder / "run" / "film.mp4", "moving");
  const Called called = call(folder, "report run");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_EQ(called.output, "Written to run/report.html\n");
  const std::string html = read_file(folder / "run" / "report.html");
  EXPECT_TRUE(contains(html, "<h1>&lt;b&gt;small &amp; &#39;bold&#39;&lt;/b&gt;, seed 1</h1>"));
  EXPECT_FALSE(contains(html, "<b>small"));
  for (const char* part :
       {"Chart.js v", "id=\"map\"", "id=\"nees-pose\"", "id=\"update-time\"", "<th scope=\"row\">ekf",
        "id=\"matrix-ekf\"", "duration_s: 20", "<dd>20 s, seed 1</dd>", "<dt>seif_report</dt><dd>K: 10,",
        "data:video/mp4;base64,bW92aW5n"})
    EXPECT_TRUE(contains(html, part)) << part;
  for (const char* network : {"src=\"http", "href=\"http", "@import", "url("})
    EXPECT_FALSE(contains(html, network)) << network;
}

TEST_F(ReportCommand, DrawsEachFigureAsPngAndSvg) {
  run();
  report("run --out page.html --figures figures");
  EXPECT_TRUE(std::filesystem::exists(folder / "page.html"));
  for (const char* figure : {"map", "position-error", "heading-error", "nees-pose", "nees-map", "update-time",
                             "matrix-ekf", "matrix-seif_report"}) {
    EXPECT_TRUE(read_file(folder / "figures" / (std::string(figure) + ".png")).starts_with("\x89PNG"))
        << figure;
    EXPECT_TRUE(contains(read_file(folder / "figures" / (std::string(figure) + ".svg")), "<svg")) << figure;
  }
}

TEST_F(ReportCommand, GoesWithoutAReplayAndWithoutTruth) {
  run();
  report("run --no-replay");
  EXPECT_FALSE(contains(read_file(folder / "run" / "report.html"), "matrix-ekf"));
  std::string summary = read_file(folder / "run" / "summary.json");
  summary.replace(summary.find("trajectory_hash") + 19, 4, "0000");
  test::write_file(folder / "run" / "summary.json", summary);
  report("run");
  EXPECT_TRUE(contains(read_file(folder / "run" / "report.html"), "cannot be replayed"));
  for (const char* file : {"truth.csv", "truth.tum", "landmarks.csv"})
    std::filesystem::remove(folder / "run" / file);
  report("run --no-replay");
  const std::string html = read_file(folder / "run" / "report.html");
  EXPECT_TRUE(contains(html, "id=\"map\""));
  EXPECT_FALSE(contains(html, "id=\"position-error\""));
}

TEST_F(ReportCommand, SaysAllThatTheTerminalSays) {
  run();
  // The filter's own belief of the pose is made far too small, and one estimator has failed.
  std::string rows = read_file(folder / "run" / "ekf_consistency.csv");
  rows = rows.substr(0, rows.find('\n') + 1) + "10,5000,2,20,20,1000\n20,6000,2,20,20,1000\n";
  test::write_file(folder / "run" / "ekf_consistency.csv", rows);
  nlohmann::ordered_json summary = nlohmann::ordered_json::parse(read_file(folder / "run" / "summary.json"));
  summary["estimators"]["seif_report"]["failure"] = "at 12 s: it was tired";
  summary["left_out"] = {{"first_s", 3.5}, {"observations", 17}};
  summary["log"] = {{"bridged", 4}};
  test::write_file(folder / "run" / "summary.json", summary.dump());
  std::filesystem::remove(folder / "run" / "landmarks.csv");
  const std::string board = call(folder, "score run --no-replay").output;
  report("run --no-replay");
  const std::string html = read_file(folder / "run" / "report.html");
  for (const char* line :
       {"ekf diverged by 10 s: the NEES of its pose is above", "seif_report failed at 12 s: it was tired",
        "Not given to the estimators, from 3.5 s on:\n  observations 17",
        "Left out of the log, or bridged: bridged 4", "The log holds no truth of the landmarks"}) {
    EXPECT_TRUE(contains(board, line)) << line << '\n' << board;
    EXPECT_TRUE(contains(html, line)) << line;
  }
}

TEST_F(ReportCommand, WritesAPageOfASweep) {
  call(folder,
       "sweep world.yaml --seeds 1..3 --vary estimators.seif_report.theta_x=4,6 --set duration_s=15 --out "
       "swept --quiet");
  report("swept");
  const std::string html = read_file(folder / "swept" / "report.html");
  for (const char* part : {"id=\"aligned\"", "estimators.seif_report.theta_x", "\"categories\":[\"4\",\"6\"]",
                           "Means over the seeds", "mean_low"})
    EXPECT_TRUE(contains(html, part)) << part;
  std::filesystem::remove(folder / "swept" / "cells" / "000002.json");
  const Called open = call(folder, "report swept");
  EXPECT_EQ(open.exit_code, 2);
  EXPECT_TRUE(contains(open.errors, "still open")) << open.errors;
}

TEST_F(ReportCommand, WritesAPageOfAStressTest) {
  ASSERT_EQ(call(folder, "stress --landmarks 100,150 --updates 20 --estimators seif --out stressed --quiet")
                .exit_code,
            0);
  report("stressed");
  const std::string html = read_file(folder / "stressed" / "report.html");
  for (const char* part : {"id=\"time\"", "100, seif update", "150, seif", "simulated second"})
    EXPECT_TRUE(contains(html, part)) << part;
  const nlohmann::json stress = nlohmann::json::parse(read_file(folder / "stressed" / "stress.json"));
  for (const nlohmann::json& row : stress["rows"]) {
    const std::string counts = "<td>" + row["warm_start"]["updates"].dump() + "</td><td>" +
                               row["warm_start"]["seen"].dump() + "</td><td>20</td>";
    EXPECT_TRUE(contains(html, counts)) << "warm start, landmarks seen, measured: " << counts;
  }
  test::write_file(folder / "stressed" / "stress.json", "{}");
  EXPECT_EQ(call(folder, "report stressed").exit_code, 2);
}

TEST_F(ReportCommand, WritesAPageOfAComparison) {
  const Called compared = call(folder, "compare world.yaml --seeds 1..3 --set duration_s=60 --out compared");
  ASSERT_EQ(compared.exit_code, 0) << compared.errors;
  EXPECT_EQ(compared.output, read_file(folder / "compared" / "comparison.txt") + "\nWritten to compared\n");
  nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(read_file(folder / "compared" / "comparison.json"));
  json["runs"][1]["summary"]["estimators"]["ekf"]["failure"] = "at 5 s: gave up";
  test::write_file(folder / "compared" / "comparison.json", json.dump());
  report("compared");
  const std::string html = read_file(folder / "compared" / "report.html");
  for (const char* part : {"id=\"mse\"", "id=\"nees-pose\"", "id=\"links\"", "id=\"runs\"",
                           "<th scope=\"col\">over ekf", "<th scope=\"row\">seif_report</th><td>3</td>",
                           "-2: ekf failed at 5 s: gave up", "(comparison.txt)", "-3\n</pre>"})
    EXPECT_TRUE(contains(html, part)) << part;
  test::write_file(folder / "compared" / "comparison.json", "{}");
  const Called broken = call(folder, "report compared");
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_TRUE(contains(broken.errors, "compared/comparison.json: is no result of a comparison"))
      << broken.errors;
}

TEST_F(ReportCommand, WritesAPageOfThePaper) {
  ASSERT_EQ(call(folder, "paper --runs 2 --set duration_s=3 --out paper --quiet").exit_code, 0);
  report("paper");
  const std::string html = read_file(folder / "paper" / "report.html");
  for (const char* part :
       {"Section 4 of the 2002 report, report2002", "<th scope=\"row\">SEIF, constant time (seif_report)",
        "6.35 +- 0.67", "id=\"nees-map\"", "id=\"runs\"", "src=\"data:image/svg+xml;base64,",
        "Figure 6: the filters side by side", "(paper.txt)", "<dt>seif_exact</dt>"})
    EXPECT_TRUE(contains(html, part)) << part;
  EXPECT_FALSE(contains(html, "src=\"figure"));
}

TEST_F(ReportCommand, ListsWhatFailed) {
  call(folder, "sweep world.yaml --seeds 1..2 --out swept --quiet");
  test::write_file(folder / "swept" / "cells" / "000001.failed", "ended by signal 9 (Killed)");
  std::filesystem::remove(folder / "swept" / "cells" / "000001.json");
  report("swept");
  const std::string html = read_file(folder / "swept" / "report.html");
  EXPECT_TRUE(contains(html, "What failed"));
  EXPECT_TRUE(contains(html, "ended by signal 9 (Killed)"));
}

TEST_F(ReportCommand, HasTheErrorsAfterLoopClosures) {
  ASSERT_EQ(call(folder, "run world.yaml --out run --quiet --set duration_s=120").exit_code, 0);
  report("run --no-replay");
  EXPECT_TRUE(contains(read_file(folder / "run" / "report.html"), "after a loop closure"));
}

TEST_F(ReportCommand, SaysWhatIsWrong) {
  const Called nothing = call(folder, "report .");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_TRUE(contains(nothing.errors, "no folder of a run")) << nothing.errors;
  run();
  const Called missing = call(folder, "report run --chart-js nowhere.js");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.errors, "nowhere.js: cannot be read: there is no such file\n");
}

class ReportInBrowser : public ReportCommand {
 protected:
  void SetUp() override {
    const std::optional<std::string> found = test::find_browser(folder);
    if (!found) GTEST_SKIP() << "there is no browser here: apt-get install chromium";
    browser = *found;
    run();
    report("run");
  }

  nlohmann::json look(const std::string& script, const test::Screen& screen = {}) {
    return nlohmann::json::parse(
        test::look_at(folder, browser, folder / "run" / "report.html", script, screen));
  }

  std::string browser;
};

TEST_F(ReportInBrowser, DrawsAllWithoutANetwork) {
  const nlohmann::json seen = look(R"(
    result.drawn = document.documentElement.dataset.drawn;
    result.blank = charts.filter((chart) => {
      const { data } = chart.ctx.getImageData(0, 0, chart.canvas.width, chart.canvas.height);
      return !data.some((value) => value !== 0);
    }).length;
    result.bold = document.querySelectorAll("b").length;
    result.loaded = performance.getEntriesByType("resource").length;)");
  EXPECT_EQ(seen["drawn"], "8") << "six plots and two matrices";
  EXPECT_EQ(seen["blank"], 0);
  EXPECT_EQ(seen["bold"], 0) << "the name of the world is text";
  EXPECT_EQ(seen["loaded"], 0);
}

TEST_F(ReportInBrowser, FitsOnAPhone) {
  const nlohmann::json seen = look(R"(
    result.page = document.documentElement.scrollWidth;
    const wide = document.querySelector(".wide");
    const scroll = wide.firstElementChild;
    const turn = async (left) => {
      scroll.scrollLeft = left;
      await until(() => wide.classList.contains("more") === (left === 0));
      const first = scroll.querySelector("tbody th").getBoundingClientRect();
      return { more: wide.classList.contains("more"), first: first.left - scroll.getBoundingClientRect().left };
    };
    result.wider = scroll.scrollWidth > scroll.clientWidth;
    result.begin = await turn(0);
    result.end = await turn(10000);
    result.window = window.innerWidth;
    result.canvas = Math.max(...charts.map((chart) => chart.width));)",
                                   {.width = 360});
  EXPECT_LE(seen["page"], seen["window"]);
  EXPECT_LE(seen["canvas"], seen["window"]);
  EXPECT_TRUE(seen["wider"]) << "the table scrolls in its box";
  EXPECT_TRUE(seen["begin"]["more"]) << "and its edge says so";
  EXPECT_FALSE(seen["end"]["more"]);
  EXPECT_NEAR(seen["end"]["first"], 0.0, 0.5) << "the first column stays";
}

TEST_F(ReportInBrowser, AMapHasMetresAsLongAlongBothAxes) {
  const nlohmann::json seen = look(R"(
    const { x, y } = charts[0].scales;
    result.ratio = ((x.max - x.min) / x.width) / ((y.max - y.min) / y.height);
    result.holds = x.min < -3 && x.max > 3 && y.min < -3 && y.max > 3;)");
  EXPECT_NEAR(seen["ratio"], 1.0, 0.02);
  EXPECT_EQ(seen["holds"], true);
}

TEST_F(ReportInBrowser, ZoomsByButtonsAndByTheMouseAndBack) {
  const nlohmann::json seen = look(R"(
    const chart = charts[1];
    const span = () => chart.scales.x.max - chart.scales.x.min;
    const [closer, farther, all] = chart.canvas.closest("figure").querySelectorAll("button");
    result.whole = span();
    closer.click();
    result.closer = span();
    all.click();
    result.all = span();
    const { left, top, width, height } = chart.chartArea;
    const frame = chart.canvas.getBoundingClientRect();
    const point = (name, part) => chart.canvas.dispatchEvent(new PointerEvent(name, {
      pointerId: 1, pointerType: "mouse", button: 0, bubbles: true,
      clientX: frame.left + left + part * width, clientY: frame.top + top + part * height }));
    point("pointerdown", 0.25);
    point("pointermove", 0.75);
    result.boxes = document.querySelectorAll(".box").length;
    point("pointerup", 0.75);
    result.dragged = span();
    chart.canvas.dispatchEvent(new MouseEvent("dblclick"));
    result.back = span();)");
  const double whole = seen["whole"];
  EXPECT_NEAR(seen["closer"], whole / 1.6, 0.02 * whole);
  EXPECT_EQ(seen["all"], whole);
  EXPECT_EQ(seen["boxes"], 1);
  EXPECT_NEAR(seen["dragged"], whole / 2, 0.02 * whole);
  EXPECT_EQ(seen["back"], whole);
}

TEST_F(ReportInBrowser, HidesAllCurvesOfANameAndTellsOfAPoint) {
  const nlohmann::json seen = look(R"(
    const chart = charts[0];
    const frame = chart.canvas.getBoundingClientRect();
    const at = (name, x, y) => chart.canvas.dispatchEvent(new MouseEvent(name, {
      clientX: frame.left + x, clientY: frame.top + y, bubbles: true }));
    const visible = () => chart.data.datasets.filter((set, i) => chart.isDatasetVisible(i)).map((set) => set.label);
    result.entries = chart.legend.legendItems.map((item) => item.text);
    result.before = visible();
    const index = result.entries.indexOf("ekf");
    const box = chart.legend.legendHitBoxes[index];
    at("click", box.left + 5, box.top + 5);
    const { x, y } = chart.getDatasetMeta(0).data[0];
    await until(() => visible().length < result.before.length);
    result.after = visible();
    at("mousemove", x, y);
    await until(() => chart.tooltip?.opacity > 0);
    result.tip = chart.tooltip.body[0].lines[0];)");
  EXPECT_EQ(seen["entries"], (nlohmann::json{"truth", "odometry", "ekf", "seif_report"}));
  nlohmann::json expected = nlohmann::json::array();
  for (const nlohmann::json& name : seen["before"]) {
    if (name != "ekf") expected.push_back(name);
  }
  EXPECT_EQ(seen["before"].size(), expected.size() + 3) << "trajectory, landmarks and ellipses";
  EXPECT_EQ(seen["after"], expected);
  EXPECT_TRUE(contains(seen["tip"], ": ")) << seen["tip"];
}

TEST_F(ReportInBrowser, ALandmarkOfTheMapTellsWhichItIs) {
  const nlohmann::json seen = look(R"(
    const chart = charts[0];
    chart.figure.curves.forEach((curve, i) => chart.setDatasetVisibility(i, curve.name === "ekf"));
    chart.update("none");
    const of = (mark) => chart.figure.curves.findIndex((curve) => curve.name === "ekf" && curve.mark === mark);
    const frame = chart.canvas.getBoundingClientRect();
    const pointAt = async ({ x, y }) => {
      chart.canvas.dispatchEvent(new MouseEvent("mousemove", {
        clientX: frame.left + x, clientY: frame.top + y, bubbles: true }));
      await until(() => chart.tooltip?.opacity > 0);
      return chart.tooltip.body[0].lines;
    };
    result.ids = chart.figure.curves[of("crosses")].landmarks.id;
    result.mark = await pointAt(chart.getDatasetMeta(of("crosses")).data[0]);
    result.ellipse = await pointAt(chart.getDatasetMeta(of("thin")).data[0]);)");
  const nlohmann::json& mark = seen["mark"];
  ASSERT_EQ(mark.size(), 5U) << mark;
  EXPECT_EQ(mark[0], "ekf: landmark " + seen["ids"][0].dump());
  for (std::size_t i = 1; i < mark.size(); ++i) {
    const char* begin[] = {"", "estimate ", "truth ", "error ", "sigma "};
    EXPECT_TRUE(mark[i].get<std::string>().starts_with(begin[i])) << mark;
  }
  EXPECT_TRUE(contains(seen["ellipse"][0], "landmark ")) << "not a point of the ellipse: " << seen["ellipse"];
}

TEST_F(ReportInBrowser, IsDarkWhereThePaperIs) {
  const std::string script = R"(
    result.paper = getComputedStyle(document.body).backgroundColor;
    result.truth = charts[0].data.datasets[0].borderColor;
    result.matrix = [...document.querySelector("#matrix-seif_report").getContext("2d").getImageData(0, 0, 1, 1).data];)";
  const nlohmann::json light = look(script);
  const nlohmann::json dark = look(script, {.width = 1280, .is_dark = true});
  EXPECT_EQ(light["paper"], "rgb(255, 255, 255)");
  EXPECT_EQ(light["truth"], "#000000");
  EXPECT_EQ(dark["paper"], "rgb(20, 24, 28)");
  EXPECT_EQ(dark["truth"], "rgb(228,232,235)");
  EXPECT_LT(light["matrix"][0], 128) << "the strongest is dark on white";
  EXPECT_GT(dark["matrix"][0], 128) << "and light on black";
}

}  // namespace
}  // namespace harness
