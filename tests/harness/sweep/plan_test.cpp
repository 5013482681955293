#include "harness/sweep/plan.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "harness/comparison/seeds.hpp"
#include "harness/files/bad_input.hpp"

namespace harness {
namespace {

using Texts = std::vector<std::string>;

SweepPlan example_plan() {
  return {"example", "0.1.0", "ekf", {1, 2, 7}, {{"a.b", {"4", "[1, 2]"}}, {"c", {"x", "y", "z"}}}};
}

TEST(SweepAxis, CommasInsideBracketsAndQuotesSeparateNothing) {
  const SweepAxis axis = parse_axis("estimators={ekf: {}, seif: {}},{seif: {K: 3}},[1,2],'a,b',6");
  EXPECT_EQ(axis.path, "estimators");
  EXPECT_EQ(axis.values, (Texts{"{ekf: {}, seif: {}}", "{seif: {K: 3}}", "[1,2]", "'a,b'", "6"}));
}

TEST(SweepAxis, ValuesAreSplitAsYamlReadsThem) {
  EXPECT_EQ(parse_axis("a.b={'x, y': 1}, {\"}\": [2, 'it''s, so']}").values,
            (Texts{"{'x, y': 1}", "{\"}\": [2, 'it''s, so']}"}));
  EXPECT_EQ(parse_axis(R"(a="x\", y",z)").values, (Texts{R"("x\", y")", "z"}));
  EXPECT_EQ(parse_axis("a=don't, can't").values, (Texts{"don't", "can't"})) << "no quotes, but letters";
  EXPECT_EQ(parse_axis("a=x],y").values, (Texts{"x]", "y"}));
  for (const char* open : {"a='x", "a=[1,2", "a={b: 1", "a=\"x\\\""})
    EXPECT_THROW(parse_axis(open), BadInput) << open;
}

TEST(ShortPaths, AreTheLastKeysWhereThoseDiffer) {
  EXPECT_EQ(short_paths(example_plan()), (Texts{"b", "c"}));
  SweepPlan plan = example_plan();
  plan.axes.push_back({"d.b", {"1"}});
  EXPECT_EQ(short_paths(plan), (Texts{"a.b", "c", "d.b"}));
}

TEST(SweepAxis, SaysWhatIsWrongAndWhatWasMeant) {
  for (const auto& [text, reason] :
       std::vector<std::pair<const char*, const char*>>{{"a.b", "no path and values"},
                                                        {"=1,2", "no path and values"},
                                                        {"a=1,,2", "a value is missing"},
                                                        {"a=", "a value is missing"},
                                                        {"a=1,2,1", "'1' stands twice"},
                                                        {"seed=1,2", "--seeds"}}) {
    try {
      parse_axis(text);
      ADD_FAILURE() << text;
    } catch (const BadInput& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(reason), std::string::npos) << what;
      EXPECT_NE(what.find("estimators.seif.theta_x=4,6,8"), std::string::npos) << what;
    }
  }
}

TEST(SweepPlan, IsTheProductWithTheSeedsFastest) {
  const SweepPlan plan = example_plan();
  ASSERT_EQ(setting_count(plan), 6U);
  ASSERT_EQ(cell_count(plan), 18U);
  EXPECT_EQ(overrides_of(plan, cell_at(plan, 0)), (Texts{"a.b=4", "c=x", "seed=1"}));
  EXPECT_EQ(overrides_of(plan, cell_at(plan, 2)), (Texts{"a.b=4", "c=x", "seed=7"}));
  EXPECT_EQ(overrides_of(plan, cell_at(plan, 3)), (Texts{"a.b=4", "c=y", "seed=1"}));
  EXPECT_EQ(overrides_of(plan, cell_at(plan, 17)), (Texts{"a.b=[1, 2]", "c=z", "seed=7"}));
  std::set<Texts> all;
  for (std::size_t i = 0; i < cell_count(plan); ++i) all.insert(overrides_of(plan, cell_at(plan, i)));
  EXPECT_EQ(all.size(), 18U);
}

TEST(SweepPlan, WithoutAxesHasOneSetting) {
  SweepPlan plan = example_plan();
  plan.axes.clear();
  EXPECT_EQ(cell_count(plan), 3U);
  EXPECT_EQ(overrides_of(plan, cell_at(plan, 1)), (Texts{"seed=2"}));
}

TEST(SweepPlan, RefusesAnAxisThatStandsTwiceAndTooManyCells) {
  SweepPlan plan = example_plan();
  plan.axes.push_back({"c", {"1"}});
  EXPECT_THROW(check_plan(plan), BadInput);
  plan = example_plan();
  for (std::size_t axis = 0; axis < 70; ++axis) plan.axes.push_back({std::string(axis + 1, 'd'), {"1", "2"}});
  EXPECT_THROW(check_plan(plan), BadInput) << "although the product wraps round";
}

TEST(SweepPlan, ComesBackFromItsFile) {
  EXPECT_EQ(plan_from_json(to_json(example_plan()), "sweep.json"), example_plan());
  for (const char* text : {"", "[]", "{\"name\": 3}"})
    EXPECT_THROW(plan_from_json(text, "sweep.json"), BadInput) << text;
}

TEST(SweepPlan, TellsWhatOfAnotherIsDifferent) {
  SweepPlan other = example_plan();
  other.baseline = "seif";
  EXPECT_EQ(difference_between(other, example_plan()), "its baseline is seif, and not ekf");
  other.axes[0].values = {"4"};
  EXPECT_EQ(difference_between(other, example_plan()),
            "its varied values are a.b=4 c=x,y,z, and not a.b=4,[1, 2] c=x,y,z");
  other.seeds = {1, 2};
  EXPECT_EQ(difference_between(other, example_plan()), "its seeds are 1..2, and not 1..2,7");
  other.version = "0.2.0";
  EXPECT_EQ(difference_between(other, example_plan()), "its program was 0.2.0, and not 0.1.0");
}

TEST(Seeds, TheirTextMeansThem) {
  for (const char* text : {"1..3,7", "0", "5..6", "1,3,5..9,9223372036854775807"}) {
    EXPECT_EQ(seeds_text(parse_seeds(text)), text);
  }
  EXPECT_EQ(seeds_text(parse_seeds("7,1,2,2,3")), "1..3,7");
}

}  // namespace
}  // namespace harness
