// Arrows between the sub-rooms of harness/ point down, and its top level stays small.
#include "floors.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rooms {
namespace {

Findings check_includes(const std::string& path, const std::string& include) {
  return check_floors(parse_source({path, "#include \"" + include + "\"\n"}));
}

TEST(Floors, LetArrowsRunDown) {
  EXPECT_EQ(check_includes("harness/commands/run.cpp", "harness/run/run.hpp"), no_findings);
  EXPECT_EQ(check_includes("harness/score/details.cpp", "harness/files/csv_reader.hpp"), no_findings);
  EXPECT_EQ(check_includes("harness/run/run.cpp", "harness/run/resume.hpp"), no_findings);
  EXPECT_EQ(check_includes("harness/run/run.cpp", "seif/estimator.hpp"), no_findings);
  EXPECT_EQ(check_includes("sim/simulator.cpp", "worlds/world.hpp"), no_findings);
}

TEST(Floors, LetNoArrowRunUpOrAlong) {
  const Findings up = {"harness/files/a.cpp:1: harness/run/run.hpp is not on a lower floor"};
  EXPECT_EQ(check_includes("harness/files/a.cpp", "harness/run/run.hpp"), up);
  const Findings along = {"harness/film/a.cpp:1: harness/stress/stress.hpp is not on a lower floor"};
  EXPECT_EQ(check_includes("harness/film/a.cpp", "harness/stress/stress.hpp"), along);
  const Findings top = {"harness/film/a.cpp:1: harness/stress.hpp is not on a lower floor"};
  EXPECT_EQ(check_includes("harness/film/a.cpp", "harness/stress.hpp"), top);
}

TEST(Floors, HoldEveryFileOfHarness) {
  const Findings flat = {"harness/a.cpp:1: is in no sub-room of harness/"};
  EXPECT_EQ(check_includes("harness/a.cpp", "harness/run/run.hpp"), flat);
  const Findings unknown = {"harness/attic/a.cpp:1: is in no sub-room of harness/"};
  EXPECT_EQ(check_includes("harness/attic/a.cpp", "harness/run/run.hpp"), unknown);
}

TEST(Floors, LeaveTheTopOfHarnessNearlyEmpty) {
  EXPECT_EQ(check_top_of_harness({"harness/1", "harness/2", "harness/3", "harness/4", "harness/5",
                                  "harness/run/run.cpp", "seif/seif.cpp"}),
            no_findings);
  const Findings expected = {"harness: 6 files stand at its top, at most 5 may"};
  EXPECT_EQ(
      check_top_of_harness({"harness/1", "harness/2", "harness/3", "harness/4", "harness/5", "harness/6"}),
      expected);
}

}  // namespace
}  // namespace rooms
