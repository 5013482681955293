// Broken logs give a message that says where the error is, and never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>
#include <variant>

#include "harness/files/bad_input.hpp"
#include "harness/fixtures.hpp"
#include "logs.hpp"

namespace harness {
namespace {

using namespace test;

LogChoice choice_of(const std::filesystem::path& folder, const Files& files) {
  LogChoice choice{.path = files.size() == 1 ? folder / files.begin()->first : folder};
  if (files.contains("Barcodes.dat")) choice.robot = 2;
  return choice;
}

struct BadLog {
  Files (*files)();
  std::string file;
  std::string from;
  std::string to;
  std::string complaint;  // after the path of the folder
};

void PrintTo(const BadLog& bad, std::ostream* out) { *out << bad.complaint; }

class BadLogs : public testing::TestWithParam<BadLog> {};
INSTANTIATE_TEST_SUITE_P(
    Logs, BadLogs,
    testing::Values(
        BadLog{mrclam_files, "Robot2_Odometry.dat", "1.0 \t 0.0", "fast 0.0",
               "/Robot2_Odometry.dat:2:12: velocity: 'fast' is not a number"},
        BadLog{mrclam_files, "Robot2_Odometry.dat", "1000.500  1.0  0.0", "1000.500 1.0",
               "/Robot2_Odometry.dat:3:13: angular velocity: is missing"},
        BadLog{mrclam_files, "Robot2_Odometry.dat", "1000.500  1.0  0.0", "1000.500 1.0 0 7",
               "/Robot2_Odometry.dat:3:16: the row has 4 values, there are 3 columns"},
        BadLog{mrclam_files, "Robot2_Measurement.dat", "  63  ", "  6.5  ",
               "/Robot2_Measurement.dat:2:8: barcode: '6.5' is not a whole number from 0 to 2147483646"},
        BadLog{mrclam_files, "Robot2_Groundtruth.dat", "1001.400", "14:01",
               "/Robot2_Groundtruth.dat:7:1: time: '14:01' is not a number"},
        BadLog{mrclam_files, "Barcodes.dat", "81", "63", "/Barcodes.dat:5:6: barcode: stands there twice"},
        BadLog{isam_files, "graph.txt", "ODOMETRY 1 2", "ODOMETRY 0 2",
               "/graph.txt:3:10: pose 0 is not where the motion before it ended, 1: edges that close a loop "
               "between poses are no odometry"},
        BadLog{isam_files, "graph.txt", "LANDMARK 2 10", "LANDMARK 3 10",
               "/graph.txt:4:10: no motion leads to pose 3"},
        BadLog{isam_files, "graph.txt", "LANDMARK 5 11", "LANDMARK 1 11",
               "/graph.txt:6:10: pose 1 comes after pose 2; observations must be in the order of the poses"},
        BadLog{isam_files, "graph.txt", "ODOMETRY 0 1", "ODOMETER 0 1",
               "/graph.txt:2:1: 'ODOMETER' is no record of a graph of poses and landmarks"},
        BadLog{isam_files, "graph.txt", "10 0 10\nODOMETRY 0", "10 0 0\nODOMETRY 0",
               "/graph.txt:1:19: information: is not positive definite"},
        BadLog{g2o_files, "graph.g2o", "1.01 0 0.01", "1.01 nan 0.01",
               "/graph.g2o:5:19: dy: 'nan' is not finite"},
        BadLog{freiburg_files, "sensor_data.dat", "SENSOR 2 3.0 -0.5", "SENSOR two 3.0 -0.5",
               "/sensor_data.dat:3:8: landmark: 'two' is not a whole number from 0 to 2147483646"},
        BadLog{freiburg_files, "sensor_data.dat", "ODOMETRY 0 0.5 0.2", "ODOMETRY 0 0.5",
               "/sensor_data.dat:4:15: second rotation: is missing"},
        BadLog{freiburg_files, "world.dat", "2 4 -1", "1 4 -1", "/world.dat: landmark 1 stands there twice"},
        BadLog{victoria_park_files, "derived_odometry.txt", "2 0.3", "2 1.3",
               "/derived_odometry.txt:4:8: steering: is more than 1.2 rad"},
        BadLog{victoria_park_files, "derived_tree_detections.txt", "9 0 0.4", "9 0",
               "/derived_tree_detections.txt:6:11: diameter: is missing"}));

TEST_P(BadLogs, AreRefusedWithFileLineColumnAndReason) {
  const BadLog& bad = GetParam();
  const TemporaryFolder folder;
  Files files = bad.files();
  std::string& text = files.at(bad.file);
  const std::size_t at = text.find(bad.from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, bad.from.size(), bad.to);
  write_files(folder.path(), files);
  try {
    const auto log = open_log(choice_of(folder.path(), files));
    read_all(*log);
    FAIL() << "it was taken";
  } catch (const BadInput& error) {
    EXPECT_EQ(error.what(), folder.path().string() + bad.complaint);
  }
}

/// The error message for a log, without its path; empty if the log is accepted.
std::string complaint_about(const LogChoice& choice) {
  try {
    read_all(*open_log(choice));
  } catch (const BadInput& error) {
    return std::string(error.what()).substr(choice.path.string().size());
  }
  return "";
}

TEST(OpenLog, RefusesWhatIsOfNoFormatAndChoicesThatAreForOthers) {
  const TemporaryFolder folder;
  write_files(folder.path(), isam_files());
  write_file(folder / "empty.txt", "");
  EXPECT_EQ(complaint_about({.path = folder / "empty.txt", .format = "graph"}), ": there is no motion in it");
  EXPECT_NE(complaint_about({.path = folder / "empty.txt"}).find("is empty"), std::string::npos);
  const std::filesystem::path graph = folder / "graph.txt";
  EXPECT_EQ(complaint_about({.path = graph, .robot = 2}), ": --robot is for MRCLAM folders");
  EXPECT_NE(complaint_about({.path = graph, .format = "walnut"}).find("no log format 'walnut'"),
            std::string::npos);
  write_files(folder / "course", freiburg_files());
  EXPECT_EQ(complaint_about({.path = folder / "course", .truth = graph}), ": --truth is for graphs");
}

TEST(GraphTruth, MustHaveTheMotionsOfTheLog) {
  const TemporaryFolder folder;
  write_files(folder.path(), isam_files());
  write_file(folder / "truth.txt", "ODOMETRY 0 1 1 0 0 50 0 0 50 0 100\n");
  try {
    read_all(*open_log({.path = folder / "graph.txt", .truth = folder / "truth.txt"}));
    FAIL() << "it was taken";
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(), "the truth has no motion from pose 1 to pose 2 where the log has one");
  }
}

/// The text with some bytes changed, removed or doubled.
std::string mutated(std::string text, std::mt19937& random) {
  const std::string bytes = "0123456789.-+e naif\n\t#,:EL\xff";
  const auto pick = [&](std::size_t size) {
    return std::uniform_int_distribution<std::size_t>(0, size - 1)(random);
  };
  for (std::size_t change = 0, changes = 1 + pick(2); change < changes && !text.empty(); ++change) {
    const std::size_t at = pick(text.size());
    switch (pick(4)) {
      case 0:
        text[at] = bytes[pick(bytes.size())];
        break;
      case 1:
        text.erase(at, 1 + pick(8));
        break;
      case 2:
        text.insert(at, 1, bytes[pick(bytes.size())]);
        break;
      default:
        text.insert(at, text.substr(pick(text.size()), 20));
    }
  }
  return text;
}

TEST(BadLogs, NoMutationOfALogDoesMoreThanBeRefused) {
  std::mt19937 random(8);
  int refused = 0;
  int taken = 0;
  for (const auto& files_of : {mrclam_files, isam_files, g2o_files, freiburg_files, victoria_park_files}) {
    for (int round = 0; round < 200; ++round) {
      const TemporaryFolder folder;
      Files files = files_of();
      auto spoilt = files.begin();
      std::advance(spoilt, std::uniform_int_distribution<std::ptrdiff_t>(
                               0, static_cast<std::ptrdiff_t>(files.size()) - 1)(random));
      spoilt->second = mutated(spoilt->second, random);
      write_files(folder.path(), files);
      try {
        const auto log = open_log(choice_of(folder.path(), files));
        for (const Event& event : read_all(*log)) {
          if (std::holds_alternative<OdometryEvent>(event)) continue;
          for (const seif::Observation& o : scan(event).scan.observations)
            ASSERT_TRUE(std::isfinite(o.range) && o.range >= 0.0 && std::isfinite(o.bearing));
        }
        ++taken;
      } catch (const BadInput&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(taken, 100);
}

TEST(OpenLog, TellsFormatsByContentAndNamesThem) {
  const TemporaryFolder folder;
  write_files(folder / "m", mrclam_files());
  write_files(folder / "v", victoria_park_files());
  write_files(folder / "f", freiburg_files());
  write_files(folder.path(), isam_files());
  write_files(folder.path(), g2o_files());
  write_file(folder / "prose.txt", "Once upon a time\n");
  EXPECT_EQ(format_of({folder / "m"}), LogFormat::mrclam);
  EXPECT_EQ(format_of({folder / "v"}), LogFormat::victoria_park);
  EXPECT_EQ(format_of({folder / "f"}), LogFormat::freiburg);
  EXPECT_EQ(format_of({folder / "f" / "sensor_data.dat"}), LogFormat::freiburg);
  EXPECT_EQ(format_of({folder / "graph.txt"}), LogFormat::graph);
  EXPECT_EQ(format_of({folder / "graph.g2o"}), LogFormat::graph);
  EXPECT_EQ(format_of({folder / "graph.g2o", "own"}), LogFormat::own);
  EXPECT_THROW(format_of({folder / "prose.txt"}), BadInput);
  EXPECT_THROW(open_log({.path = folder / "graph.txt", .robot = 1}), BadInput);
  EXPECT_THROW(open_log({.path = folder / "m", .robot = 4}), BadInput);
}

}  // namespace
}  // namespace harness
