#include "harness/report/page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/files/base64.hpp"
#include "harness/film/frame_sink.hpp"
#include "harness/film/poster.hpp"
#include "harness/fixtures.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/report/run_figures.hpp"
#include "harness/report/world_facts.hpp"
#include "worlds/degree.hpp"

namespace harness {
namespace {

const std::string evil = "<script>alert('\"&\"')</script>{{data}}";

std::string html_of(const Page& page) { return to_html(page, "/nowhere/report.html", "/* library */"); }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string encoded(const std::string& text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(Base64, HasTheValuesOfTheRfc) {
  for (const auto& [text, expected] : {std::pair("", ""), std::pair("f", "Zg=="), std::pair("fo", "Zm8="),
                                       std::pair("foo", "Zm9v"), std::pair("foobar", "Zm9vYmFy")})
    EXPECT_EQ(encoded(text), expected);
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xFB, 0xFF}), "+/8=");
}

TEST(Escaped, LeavesNoSignOfHtml) {
  EXPECT_EQ(escaped(R"(<a b="c" d='e'>&amp;)"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;amp;");
}

TEST(Page, TextsOfUsersStayTexts) {
  Page page;
  page.title = evil;
  page.facts = {{evil, evil}};
  page.notes = "\n" + evil + "\n";
  page.tables = {{evil, {{evil, evil}, {evil, evil}}, evil}};
  page.details = page.tables;
  page.descriptions = {{evil, evil, {{evil, evil}}}};
  page.figures = {{.id = "map", .title = evil, .caption = evil, .x = {evil}, .y = {evil}}};
  page.figures[0].categories = {evil};
  page.figures[0].bands = {{evil, 0, 1}};
  page.figures[0].curves = {{evil, 0, Mark::line, {1}, {2}}};
  page.matrices = {{.id = "matrix", .title = evil, .caption = evil, .size = 1, .cells = {7}}};
  page.matrices_note = evil;
  page.listings = {{evil, evil}};
  const std::string html = html_of(page);
  EXPECT_FALSE(contains(html, "<script>alert"));
  EXPECT_TRUE(
      contains(html, "<title>&lt;script&gt;alert(&#39;&quot;&amp;&quot;&#39;)&lt;/script&gt;{{data}}"));
}

TEST(Page, HasAParagraphForEachOfTheNotes) {
  Page page;
  EXPECT_FALSE(contains(html_of(page), "<h2>Notes</h2>"));
  page.notes = "\nfirst:\n  more of it\n\nsecond\n";
  const std::string html = html_of(page);
  EXPECT_TRUE(contains(html, "<p>first:\n  more of it</p>\n<p>second</p>\n</section>")) << html;
}

/// The JSON that the page's script reads.
nlohmann::json data_of(const Page& page) {
  const std::string html = html_of(page);
  const std::string before = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = html.find(before) + before.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(Page, HoldsTheFiguresAsData) {
  Page page;
  page.figures = {{.id = "time", .title = evil, .x = {"t"}, .y = {"us", true}}};
  page.figures[0].bands = {{"95 %", 0.25, 3.5}};
  page.figures[0].curves = {{evil, 0x0072B2, Mark::circles, {0, 1, gap, 3}, {-1, 0, 1, 1234567.89}}};
  const nlohmann::json figure = data_of(page)["figures"][0];
  EXPECT_EQ(figure["title"], evil);
  EXPECT_EQ(figure["bands"][0]["high"], 3.5);
  const nlohmann::json curve = figure["curves"][0];
  EXPECT_EQ(curve["name"], evil);
  EXPECT_EQ(curve["colour"], "#0072b2");
  EXPECT_EQ(curve["mark"], "circles");
  EXPECT_EQ(curve["x"], (nlohmann::json{0, 1, nullptr, 3}));
  EXPECT_EQ(curve["y"], (nlohmann::json{nullptr, nullptr, 1, 1234568})) << "a logarithm of -1 or 0 is none";
}

TEST(Page, HoldsASmallFilmAndLinksALargeOne) {
  const TemporaryFolder folder;
  Page page;
  page.film = folder / "a film & more.mp4";
  test::write_file(*page.film, "moving");
  const std::string small = to_html(page, folder / "report.html", "");
  EXPECT_TRUE(
      contains(small, "<video controls playsinline preload=\"metadata\" src=\"data:video/mp4;base64," +
                          encoded("moving") + "\">"));
  EXPECT_TRUE(contains(small, "<a href=\"a%20film%20%26%20more.mp4\">a film &amp; more.mp4</a>"));
  std::filesystem::resize_file(*page.film, largest_film);
  const std::string large = to_html(page, folder / "pages/report.html", "");
  EXPECT_TRUE(contains(large, "src=\"../a%20film%20%26%20more.mp4\""));
  EXPECT_LT(large.size(), 100'000U);
}

TEST(Page, ShowsTheLastFrameOfAVideoUntilItPlays) {
  const TemporaryFolder folder;
  Page page;
  page.film = folder / "film.mp4";
  const auto sink = make_frame_sink(*page.film, {64, 48, 10}, false);
  sink->write({64, 48, std::vector<std::uint8_t>(std::size_t{3} * 64 * 48, 99)});
  sink->finish();
  const std::string html = to_html(page, folder / "report.html", "");
  EXPECT_TRUE(contains(html, "poster=\"data:image/jpeg;base64," + encoded(poster_of(*page.film)) + "\""));
}

TEST(WorldFacts, SayInWordsWhatTheWorldFileSays) {
  worlds::World world = test::small_world();
  world.name = "hall";
  world.description = "a hall with pillars";
  world.seed = 7;
  world.duration = 90;
  world.ground_size = {30, 20};
  world.walls = {{.points = {{0, 0}, {3, 0}, {3, 4}}}};
  world.boxes.resize(2);
  world.landmark_sensor.max_range = 6;
  world.landmark_sensor.range_sd = 0.05;
  world.landmark_sensor.range_sd_per_m = 0.01;
  world.landmark_sensor.bearing_sd = 2 * worlds::degree;
  world.landmark_sensor.miss_probability = 0.1;
  world.faults.resize(3);
  world.faults[1].kind = worlds::FaultKind::landmark;
  world.faults[1].at = 14;
  world.faults[2] = {.kind = worlds::FaultKind::option, .at = 15};
  world.faults[2].estimator = "seif";
  world.faults[2].option = "theta_x";
  world.faults[2].option_value = 4;
  world.faults[0].kind = worlds::FaultKind::kidnapping;
  world.faults[0].at = 12;
  const Description about = describe(world);
  EXPECT_EQ(about.text, "a hall with pillars");
  const auto fact = [&](const std::string& name) {
    const auto found = std::ranges::find(about.facts, name, &Fact::name);
    return found == about.facts.end() ? std::string() : found->value;
  };
  EXPECT_EQ(fact("Name"), "hall");
  EXPECT_EQ(fact("Size of the ground"), "30 x 20 m");
  EXPECT_TRUE(fact("Landmarks").starts_with("12, radius ")) << fact("Landmarks");
  EXPECT_EQ(fact("Walls and boxes"), "1 wall, 7.0 m in all; 2 boxes");
  EXPECT_EQ(fact("Duration and seed"), "90 s, seed 7");
  EXPECT_TRUE(fact("Landmark sensor").find("up to 6 m") != std::string::npos) << fact("Landmark sensor");
  EXPECT_EQ(fact("Noise of the sensor"), "0.05 m and 1 % of the range in range, 2 deg in bearing");
  EXPECT_EQ(fact("Mistakes of the sensor"), "misses 10 % of what it could see");
  EXPECT_EQ(fact("Faults on purpose"),
            "kidnapping at 12 s, a landmark at 14 s, another option (seif: theta_x = 4) at 15 s");
}

TEST(WorldFacts, NameTheOptionsOfEstimators) {
  worlds::EstimatorChoice choice;
  choice.name = "mine";
  choice.type = "seif";
  choice.odometry_sd_factor = 2;
  choice.options = {{"theta_x", std::int64_t{6}}, {"gate", 0.5}, {"mean_recovery", std::string("tree")}};
  const Description about = describe(std::vector{choice});
  ASSERT_EQ(about.facts.size(), 1U);
  EXPECT_EQ(about.facts[0].name, "mine");
  EXPECT_EQ(about.facts[0].value,
            "type seif, takes the odometry's noise times 2, gate: 0.5, mean_recovery: tree, theta_x: 6");
}

TEST(Drawn, HasTheColoursOfItsTypesAndNoneTwice) {
  const std::vector<Drawn> estimators =
      drawn({"ekf", "seif", "by_tree", "third"}, {"ekf", "seif", "seif", "seif"});
  EXPECT_EQ(estimators[0].colour, colour_of_estimator("ekf"));
  EXPECT_EQ(estimators[1].colour, colour_of_estimator("seif"));
  for (std::size_t i = 0; i < estimators.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(estimators[i].colour, estimators[k].colour);
  }
}

}  // namespace
}  // namespace harness
