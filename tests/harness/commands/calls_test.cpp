// Calls with mistakes in them, streams that cannot be written, folders that cannot be used.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/command_call.hpp"
#include "harness/files/file_lock.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

namespace fs = std::filesystem;
using test::call;
using test::call_program;
using test::Called;

constexpr const char* tiny_world =
    "name: tiny\n"
    "duration_s: 2\n"
    "landmarks: {generators: [{type: uniform, count: 20}]}\n"
    "estimators: {ekf: {}, seif_report: {}}\n";

void write_tiny(const TemporaryFolder& folder) { test::write_file(folder / "world.yaml", tiny_world); }

struct Mistake {
  const char* arguments;
  const char* meant;
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreToldWithWhatWasMeant) {
  const TemporaryFolder folder;
  write_tiny(folder);
  const Called called = call(folder, GetParam().arguments);
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_EQ(called.output, "");
  EXPECT_NE(called.errors.find(GetParam().meant), std::string::npos) << called.errors;
  EXPECT_LT(called.errors.size(), 400U) << called.errors;
}

INSTANTIATE_TEST_SUITE_P(
    Calls, Mistakes,
    testing::Values(
        Mistake{"ruin world.yaml", "there is no command 'ruin' (did you mean 'run'?)"},
        Mistake{"help ruin", "there is no command 'ruin' (did you mean 'run'?)"},
        Mistake{"run world.yaml --sed 3", "there is no option '--sed' (did you mean '--seed'?)"},
        Mistake{"run world.yaml --durat=3", "there is no option '--durat' (did you mean '--duration'?)"},
        Mistake{"score run --rpe 3", "there is no option '--rpe' (did you mean '--rpe-m'?)"},
        Mistake{"--limit 3 run world.yaml", "there is no option '--limit' (did you mean '--limits'?)"},
        Mistake{"run world.yaml --limits 2", "it stands before the command: seifbed --limits"},
        Mistake{"run world.yaml other.yaml", "'other.yaml' is one word too many"},
        Mistake{"export run --format tmu", "(did you mean 'tum'?)"},
        Mistake{"validate world.yaml --set robot.mass=3", "unknown key 'mass' (did you mean 'mass_kg'?)"},
        Mistake{"run world.yaml --seeds 1..3", "seifbed compare WORLD --seeds 1..20"},
        Mistake{"stress --seeds 1..3", "--seed 7"},
        Mistake{"score run --seed 3", "seifbed run WORLD --seed 7"},
        Mistake{"validate world.yaml --seed 3", "--set seed=7"},
        Mistake{"compare world.yaml --seed 3 --seeds 1..2", "--seed"},
        Mistake{"compare world.yaml --set seed=3", "seeds are given by --seeds"},
        Mistake{"compare . --duration 3", "--duration is for worlds"},
        Mistake{"paper --seeds 1,3", "follow one another"},
        Mistake{"sweep world.yaml --seeds 1..2 --out s --set seed=3", "seeds are given by --seeds"},
        Mistake{"sweep world.yaml --seeds 1 --out s --set duration_s=3 --vary duration_s=1,2",
                "--set duration_s=3: would have no effect"},
        Mistake{"sweep world.yaml --seeds 1 --out s --vary robot.mass_kg=3 --vary 'robot={mass_kg: 4}'",
                "--vary robot.mass_kg: would have no effect"},
        Mistake{"sweep world.yaml --seeds 1 --out s --vary \"name='a\"", "is not closed"}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, Mistakes,
    testing::Values(
        Mistake{"score run --rpe-m nan", "--rpe-m: 'nan' is not allowed: it must be a number more than 0"},
        Mistake{"score run --rpe-m 1,-2", "--rpe-m: '-2' is not allowed"},
        Mistake{"score run --away-s inf", "--away-s: 'inf' is not allowed"},
        Mistake{"run world.yaml --duration 1e300", "more than 0 and at most 1000000"},
        Mistake{"run world.yaml --seed 9223372036854775808", "from 0 to 9223372036854775807"},
        Mistake{"run world.yaml --set seed=9223372036854775808", "at most 9223372036854775807"},
        Mistake{"compare world.yaml --seeds 9223372036854775808", "from 0 to 9223372036854775807"},
        Mistake{"compare world.yaml --jobs 1.5",
                "'1.5' is not allowed: it must be a whole number from 1 to 256"},
        Mistake{"paper --runs 99999999999999999999999", "--runs"},
        Mistake{"stress --slowest nan", "--slowest: 'nan'"}, Mistake{"stress --limit ekf=5x", "is not like"},
        Mistake{"film run --at nan", "--at: 'nan' is not allowed: it must be a number from 0 to"},
        Mistake{"film run --fps 0", "--fps: '0' is not allowed"},
        Mistake{"--limits nan run world.yaml", "seifbed: --limits: 'nan' is not allowed"},
        Mistake{"replay run --robot 0", "--robot: '0' is not allowed: it must be a whole number from 1 to"}));

TEST(Calls, TheLargestSeedRunsAndIsValidInTheSchema) {
  const TemporaryFolder folder;
  write_tiny(folder);
  EXPECT_EQ(call(folder, "run world.yaml --quiet --seed 9223372036854775807").exit_code, 0);
  const auto schema = nlohmann::json::parse(call(folder, "schema").output);
  EXPECT_EQ(schema.at("properties").at("seed").at("maximum"), 9223372036854775807);
}

TEST(Calls, HelpIsACommandToo) {
  const TemporaryFolder folder;
  const Called help = call(folder, "help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.output, call(folder, "--help").output);
  EXPECT_EQ(call(folder, "help run").output, call(folder, "run --help").output);
}

TEST(Calls, ProblemsOfWorldsArePrintedAsJson) {
  const TemporaryFolder folder;
  write_tiny(folder);
  test::write_file(folder / "bad.yaml", std::string(tiny_world) + "robot: {masss_kg: 3}\n");
  const Called called = call(folder, "validate world.yaml bad.yaml --json");
  EXPECT_EQ(called.exit_code, 2);
  EXPECT_EQ(called.errors, "");
  const auto json = nlohmann::json::parse(called.output);
  EXPECT_EQ(json.at("valid"), false);
  EXPECT_EQ(json.at("files").at(0).at("landmarks"), 20);
  const nlohmann::json problem = json.at("files").at(1).at("problems").at(0);
  EXPECT_EQ(problem.at("file"), "bad.yaml");
  EXPECT_EQ(problem.at("line"), 5);
  EXPECT_EQ(problem.at("column"), 9);
  EXPECT_EQ(problem.at("message"), "unknown key 'masss_kg' (did you mean 'mass_kg'?)");
}

TEST(Calls, EstimatorsArePrintedAsJson) {
  const TemporaryFolder folder;
  const auto json = nlohmann::json::parse(call(folder, "estimators --json").output);
  EXPECT_EQ(json.at("ekf").at("options").at(0).at("key"), "gate");
}

TEST(Calls, AComparisonIsWrittenAndPrintedAlike) {
  const TemporaryFolder folder;
  write_tiny(folder);
  const Called called = call(folder, "compare world.yaml --seeds 3,4 --duration 1 --out there");
  EXPECT_EQ(called.exit_code, 0) << called.errors;
  EXPECT_EQ(called.output, test::read_file(folder / "there" / "comparison.txt") + "\nWritten to there\n");
  const auto json = nlohmann::json::parse(test::read_file(folder / "there" / "comparison.json"));
  EXPECT_EQ(json.at("seeds"), nlohmann::json({3, 4}));
  EXPECT_EQ(json.at("baseline"), "ekf");
  EXPECT_TRUE(json.at("estimators").at("seif_report").at("landmark_mse_ratio").contains("low"));
  EXPECT_NEAR(json.at("runs").at(1).at("summary").at("duration_s").get<double>(), 1.0, 0.1);
  EXPECT_EQ(call(folder, "compare world.yaml --seed 3 --out there").exit_code, 2) << "it is not empty";
}

// Some of the estimators can do without names: validate and run agree that the world is fine.
TEST(Calls, HiddenIdsAreEnough) {
  const TemporaryFolder folder;
  write_tiny(folder);
  const std::string hidden = "world.yaml --set sensors.landmark_sensor.ids=hidden";
  EXPECT_EQ(call(folder, "validate " + hidden).exit_code, 0);
  const Called run = call(folder, "run " + hidden);
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_NE(run.output.find("seif_report was left out"), std::string::npos) << run.output;
  const std::string steered = hidden + " --set drive.pose_from=seif_report";
  EXPECT_EQ(call(folder, "validate " + steered).errors, call(folder, "run " + steered).errors);
  EXPECT_EQ(call(folder, "validate " + steered).exit_code, 2);
}

TEST(Calls, ASweepTakesASingleSeed) {
  const TemporaryFolder folder;
  write_tiny(folder);
  const Called swept = call(folder, "sweep world.yaml --seed 3 --set duration_s=1 --out there --json");
  EXPECT_EQ(swept.exit_code, 0) << swept.errors;
}

TEST(Calls, ControlCharactersOfTheInputDoNotReachTheTerminal) {
  const TemporaryFolder folder;
  test::write_file(folder / "world.yaml",
                   std::string("name: \"a\\e[31mb\"\n") + tiny_world + "\"\\e]0;x\": 3\n");
  for (const char* arguments :
       {"validate $'no\\e[2Jne'", "validate $'no\\x9bne'", "validate world.yaml", "$'ru\\e[2Jn'"}) {
    const Called called =
        call_program(folder, std::string("bash -c \"exec '" SEIFBED_PROGRAM "' ") + arguments + "\"");
    EXPECT_EQ(called.exit_code, 2) << arguments;
    EXPECT_EQ((called.output + called.errors).find('\033'), std::string::npos) << called.errors;
    EXPECT_EQ((called.output + called.errors).find('\x9b'), std::string::npos) << called.errors;
    EXPECT_NE(called.errors, "");
  }
}

TEST(Calls, AStreamThatCannotBeWrittenChangesNoExitCodeButZero) {
  const TemporaryFolder folder;
  write_tiny(folder);
  for (const char* to : {"2>&-", "2>/dev/full"}) {
    const std::string program = std::string("{ '" SEIFBED_PROGRAM "' ");
    EXPECT_EQ(call_program(folder, program + "run world.yaml --set foo=3 " + to + "; }").exit_code, 2) << to;
    EXPECT_EQ(call_program(folder, program + "ruin " + to + "; }").exit_code, 2) << to;
  }
  for (const char* arguments :
       {"validate world.yaml", "schema", "estimators", "--help", "--version", "help"}) {
    EXPECT_EQ(call(folder, std::string(arguments) + " >/dev/full").exit_code, 1) << arguments;
    EXPECT_EQ(call(folder, std::string(arguments) + " >&-").exit_code, 1) << arguments;
  }
  EXPECT_EQ(call(folder, "validate no.yaml world.yaml >/dev/full").exit_code, 2);
}

TEST(Calls, AFolderThatCannotBeUsedIsToldInWords) {
  const TemporaryFolder folder;
  write_tiny(folder);
  test::write_file(folder / "runs", "a file");
  const Called taken = call(folder, "run world.yaml");
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_NE(taken.errors.find("runs: no folder can be made here, in "), std::string::npos) << taken.errors;
  EXPECT_NE(taken.errors.find("--out says where"), std::string::npos) << taken.errors;
  const std::string world = (folder / "world.yaml").string();
  const std::string in_deleted = "mkdir -p gone; ( cd gone && rmdir ../gone && ";
  for (const std::string arguments : {"run ", "sweep --seeds 1..2 --out there "}) {
    const Called gone =
        call_program(folder, in_deleted + "'" SEIFBED_PROGRAM "' " + arguments + world + " 2>&1 )");
    EXPECT_EQ(gone.exit_code, 2) << gone.output;
    EXPECT_NE(gone.output.find("was deleted or moved"), std::string::npos) << gone.output;
    EXPECT_EQ(gone.output.find("filesystem error"), std::string::npos) << gone.output;
  }
}

/// What the program prints on a terminal. `environment` has assignments, as for env.
std::string on_terminal(const TemporaryFolder& folder, const std::string& environment,
                        const std::string& arguments) {
  return call_program(folder, "env -u NO_COLOR " + environment +
                                  " /usr/bin/script --quiet --return --command '" SEIFBED_PROGRAM " " +
                                  arguments + "' /dev/null")
      .output;
}

TEST(Calls, ErrorsAreRedOnATerminalThatShowsColours) {
  const TemporaryFolder folder;
  const std::string coloured = on_terminal(folder, "TERM=xterm", "validate nothing.yaml");
  EXPECT_TRUE(coloured.starts_with("\033[31mnothing.yaml")) << coloured;
  for (const char* environment : {"TERM=dumb", "TERM=xterm NO_COLOR=1"})
    EXPECT_TRUE(on_terminal(folder, environment, "validate nothing.yaml").starts_with("nothing.yaml"))
        << environment;
  EXPECT_TRUE(call(folder, "validate nothing.yaml", "TERM=xterm").errors.starts_with("nothing.yaml"));
}

TEST(Calls, WhatIsWrongIsRedInTheTableOfDoctor) {
  const TemporaryFolder folder;
  const std::string coloured = on_terminal(folder, "TERM=xterm PATH=/nowhere", "doctor");
  EXPECT_NE(coloured.find("\033[31m  BAD   ffmpeg"), std::string::npos) << coloured;
  const std::string plain = on_terminal(folder, "TERM=dumb PATH=/nowhere", "doctor");
  EXPECT_NE(plain.find("  BAD   ffmpeg"), std::string::npos) << plain;
  EXPECT_EQ(plain.find('\033'), std::string::npos) << plain;
}

TEST(Calls, AValueThatIsGivenTwiceIsRefused) {
  const TemporaryFolder folder;
  write_tiny(folder);
  ASSERT_EQ(call(folder, "run world.yaml --quiet --out log").exit_code, 0);
  for (const char* arguments :
       {"run world.yaml --set seed=3 --seed 4", "run world.yaml --duration 3 --set duration_s=4",
        "compare world.yaml --duration 3 --set duration_s=4", "replay log --set seed=3 --seed 4",
        "compare log --set seed=3 --seed 4"}) {
    const Called called = call(folder, arguments);
    EXPECT_EQ(called.exit_code, 2) << arguments;
    EXPECT_NE(called.errors.find("leave one of them out"), std::string::npos) << called.errors;
  }
}

TEST(Calls, ARunThatAnotherProcessWritesIsStillGoingOn) {
  const TemporaryFolder folder;
  write_tiny(folder);
  ASSERT_EQ(call(folder, "run world.yaml --quiet --out run").exit_code, 0);
  fs::remove(folder / "run" / "summary.json");
  test::write_file(folder / "run" / "unfinished", "");
  const std::string commands[] = {"score run", "report run --no-replay", "export run --format csv"};
  for (const std::string& command : commands)
    EXPECT_NE(call(folder, command).errors.find("was cut off"), std::string::npos) << command;
  const FileLock writer(folder / "run" / "unfinished");
  for (const std::string& command : commands) {
    const std::string errors = call(folder, command).errors;
    EXPECT_NE(errors.find("is still going on"), std::string::npos) << command << errors;
    EXPECT_EQ(errors.find("cut off"), std::string::npos) << command << errors;
  }
  const Called resumed = call(folder, "run --resume run");
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_NE(resumed.errors.find("is still going on"), std::string::npos) << resumed.errors;
}

TEST(Calls, TheStatusOfASweepSaysWhetherItIsStillGoingOn) {
  const TemporaryFolder folder;
  write_tiny(folder);
  ASSERT_EQ(call(folder, "sweep world.yaml --seeds 1..2 --shard 1/2 --quiet --out there").exit_code, 0);
  const std::string cut = call(folder, "sweep --status there").output;
  EXPECT_NE(cut.find("1 open\nnot going on: seifbed sweep --resume "), std::string::npos) << cut;
  const FileLock worker(folder / "there" / "sweep.json");
  const std::string alive = call(folder, "sweep --status there").output;
  EXPECT_NE(alive.find("1 open\nstill going on\n"), std::string::npos) << alive;
}

TEST(Calls, TemporaryFoldersOfKilledProcessesAreSwept) {
  const TemporaryFolder folder;
  write_tiny(folder);
  ASSERT_EQ(call(folder, "run world.yaml --quiet --out run").exit_code, 0);
  const fs::path temporary = folder / "temporary";
  const std::string nobody = "seifbed_999999999_abcdef";  // no process has such a number
  const std::string ours = "seifbed_" + std::to_string(getpid()) + "_abcdef";
  for (const std::string& name :
       {nobody, std::string("seifbed_999999998_locked"), ours, std::string("seifbed_mine")})
    fs::create_directories(temporary / name / "inner");
  const FileLock holder(temporary / "seifbed_999999998_locked");
  ASSERT_EQ(call(folder, "score run --no-replay", "TMPDIR=$PWD/temporary").exit_code, 0);
  EXPECT_FALSE(fs::exists(temporary / nobody));
  EXPECT_TRUE(fs::exists(temporary / ours)) << "its process lives";
  EXPECT_TRUE(fs::exists(temporary / "seifbed_999999998_locked")) << "somebody holds it";
  EXPECT_TRUE(fs::exists(temporary / "seifbed_mine")) << "it is somebody else's";
  EXPECT_EQ(std::distance(fs::directory_iterator(temporary), {}), 3);
}

}  // namespace
}  // namespace harness
