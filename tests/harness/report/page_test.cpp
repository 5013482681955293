#include "harness/report/page.hpp"

#include <gtest/gtest.h>

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
  page.tables = {{evil, {{evil, evil}, {evil, evil}}, evil}};
  page.details = page.tables;
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
