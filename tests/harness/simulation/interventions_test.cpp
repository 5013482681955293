// What somebody does to a running simulation is what a world file with the same fault, or with the same rows of a
// takeover, does at that time: to the bit, on six seeds and in both engines.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "allocation_counter.hpp"
#include "harness/fixtures.hpp"
#include "harness/simulation/simulated_stream.hpp"

namespace harness {
namespace {

using worlds::Engine;
using worlds::Fault;
using worlds::FaultKind;
using worlds::FaultySensor;
using worlds::Takeover;

using Bits = std::vector<std::uint64_t>;
using Events = std::vector<Bits>;  // all numbers of each event

constexpr std::uint64_t seeds[] = {1, 2, 3, 4, 5, 6};
constexpr double on_a_scan = 1200.0 / 240.0;         // [s]
constexpr double between_readings = 1207.0 / 240.0;  // [s]

void add(Bits& bits, double value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); }

void add(Bits& bits, const TruePose& truth) {
  for (const double value : {truth.t, truth.T_world_robot.x, truth.T_world_robot.y, truth.T_world_robot.theta,
                             truth.left_wheel, truth.right_wheel})
    add(bits, value);
}

Bits bits_of(const Event& event) {
  Bits bits;
  if (const auto* reading = std::get_if<OdometryEvent>(&event)) {
    const seif::Pose2& moved = reading->odometry.T_previous_current;
    for (const double value : {reading->odometry.t, moved.x, moved.y, moved.theta}) add(bits, value);
    for (const double value : reading->odometry.covariance.reshaped()) add(bits, value);
    add(bits, *reading->truth);
    return bits;
  }
  const auto& scan = std::get<ScanEvent>(event);
  add(bits, scan.scan.t);
  for (const seif::Observation& seen : scan.scan.observations) {
    bits.push_back(static_cast<std::uint64_t>(seen.landmark));
    for (const double value : {seen.range, seen.bearing, seen.covariance(0, 0), seen.covariance(1, 1)})
      add(bits, value);
  }
  add(bits, *scan.truth);
  return bits;
}

/// What happened in a run: its events, and the landmarks that its description tells of in the end.
struct Course {
  Events events;
  std::vector<TrueLandmark> landmarks;
  sim::RobotState robot;

  bool operator==(const Course& other) const {
    if (events != other.events || landmarks.size() != other.landmarks.size()) return false;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const TrueLandmark& a = landmarks[i];
      const TrueLandmark& b = other.landmarks[i];
      if (a.landmark != b.landmark || a.position != b.position || a.radius != b.radius) return false;
    }
    return robot.position == other.robot.position && robot.heading == other.robot.heading;
  }
};

Course rest_of(SimulatedStream& stream) {
  Course course;
  Event event;
  while (stream.next(event)) course.events.push_back(bits_of(event));
  course.landmarks = *stream.description().landmarks;
  course.robot = stream.robot();
  return course;
}

Course course_of(const worlds::World& world) {
  SimulatedStream stream(world, {});
  return rest_of(stream);
}

/// Something done as late as it can be done for this time. [s]
struct Deed {
  double at = 0.0;
  std::function<void(SimulatedStream&)> act;
};

/// Step by step, with deeds in the order of time.
Course course_with(const worlds::World& world, const std::vector<Deed>& deeds) {
  SimulatedStream stream(world, {});
  Course course;
  std::size_t next = 0;
  Event event;
  for (auto done = SimulatedStream::Advance::step; done != SimulatedStream::Advance::end;) {
    while (next < deeds.size() && !stream.is_due() && stream.next_step_t() >= deeds[next].at)
      deeds[next++].act(stream);
    done = stream.advance(event);
    if (done == SimulatedStream::Advance::event) course.events.push_back(bits_of(event));
  }
  EXPECT_EQ(next, deeds.size());
  course.landmarks = *stream.description().landmarks;
  course.robot = stream.robot();
  return course;
}

Deed injection_of(const Fault& fault) {
  return {fault.at, [fault](SimulatedStream& stream) { stream.inject(fault); }};
}

Deed takeover_by(const Takeover& row) {
  return {row.t, [row](SimulatedStream& stream) { stream.take_over(row); }};
}

worlds::World world_of(Engine engine, std::uint64_t seed) {
  worlds::World world = test::small_world();  // at 5 s the robot is near (3, 0) and drives north
  world.physics.engine = engine;
  world.seed = seed;
  world.duration = 12.0;
  world.landmark_sensor.miss_probability = 0.1;
  return world;
}

worlds::World with(worlds::World world, const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) world.faults.push_back(fault);
  return world;
}

Fault fault_of(FaultKind kind, double at) {
  Fault fault;
  fault.kind = kind;
  fault.at = at;
  fault.size = 40.0;
  fault.jump = 0.5;
  fault.duration = 2.0;
  fault.to = {{-2.0, -1.0}, -2.0};
  fault.patch = {{-20.0, -20.0}, {20.0, 20.0}, 0.01};
  fault.wall.points = {{1.5, 2.4}, {4.5, 2.4}};
  fault.landmark = {{5.0, 1.5}, 0.15};
  return fault;
}

std::vector<FaultKind> kinds_in(Engine engine) {
  std::vector<FaultKind> kinds = {FaultKind::bad_observation, FaultKind::outlier,    FaultKind::encoder_jump,
                                  FaultKind::silence,         FaultKind::kidnapping, FaultKind::landmark};
  if (engine == Engine::bullet) kinds.insert(kinds.end(), {FaultKind::ice, FaultKind::wall});
  return kinds;
}

class Interventions : public testing::TestWithParam<Engine> {};

INSTANTIATE_TEST_SUITE_P(Engines, Interventions, testing::Values(Engine::bullet, Engine::kinematic),
                         [](const auto& engine) {
                           return engine.param == Engine::bullet ? "Bullet" : "Kinematic";
                         });

TEST_P(Interventions, GiveTheBitsOfAWorldFileWithTheSameFault) {
  for (const std::uint64_t seed : seeds) {
    const worlds::World world = world_of(GetParam(), seed);
    const Course plain = course_of(world);
    for (const FaultKind kind : kinds_in(GetParam())) {
      for (const double at : {on_a_scan, between_readings}) {
        const Fault fault = fault_of(kind, at);
        const Course from_file = course_of(with(world, {fault}));
        EXPECT_FALSE(from_file.events == plain.events) << "kind " << static_cast<int>(kind);
        EXPECT_TRUE(course_with(world, {injection_of(fault)}) == from_file)
            << "kind " << static_cast<int>(kind) << ", seed " << seed << ", at " << at;
      }
    }
  }
}

// Until its time nothing tells of it, not even the landmark that is described from the start.
TEST_P(Interventions, ChangeNothingBeforeTheirTime) {
  const worlds::World world = world_of(GetParam(), 2);
  const Events plain = course_of(world).events;
  for (const FaultKind kind : kinds_in(GetParam())) {
    const Events events = course_of(with(world, {fault_of(kind, between_readings)})).events;
    // 20 readings and five scans a second; the first 5 s are equal, and what happens at 5 s.
    for (std::size_t i = 0; i < 125; ++i) ASSERT_EQ(events.at(i), plain.at(i)) << static_cast<int>(kind);
  }
}

TEST_P(Interventions, OfAllKindsTogetherGiveTheBitsOfTheFile) {
  for (const std::uint64_t seed : seeds) {
    const worlds::World world = world_of(GetParam(), seed);
    std::vector<Fault> faults;
    for (const double at : {between_readings, between_readings + 1.0, between_readings + 3.5}) {
      for (const FaultKind kind : kinds_in(GetParam())) {
        Fault fault = fault_of(kind, at);
        if (kind == FaultKind::kidnapping) fault.to.position.x() += 0.1 * at;
        if (kind == FaultKind::landmark) fault.landmark.position.y() += at;
        if (kind == FaultKind::wall) fault.wall.points = {{-4.0, at}, {0.0, at}};
        faults.push_back(fault);
      }
    }
    std::vector<Deed> deeds;
    for (const Fault& fault : faults) deeds.push_back(injection_of(fault));
    EXPECT_TRUE(course_with(world, deeds) == course_of(with(world, faults))) << "seed " << seed;
  }
}

TEST_P(Interventions, ASilenceThatIsEndedIsOneOfThatDuration) {
  for (const FaultySensor sensor : {FaultySensor::encoders, FaultySensor::landmark_sensor}) {
    for (const std::uint64_t seed : seeds) {
      for (const double lasts : {2.0, 473.0 / 240.0}) {  // the latter ends with a scan
        const worlds::World world = world_of(GetParam(), seed);
        Fault silence = fault_of(FaultKind::silence, between_readings);
        silence.sensor = sensor;
        silence.duration = worlds::open_end;
        const Deed end{between_readings + lasts, [&](SimulatedStream& stream) {
                         stream.end_silence(sensor, between_readings + lasts);
                       }};
        const Course ended = course_with(world, {injection_of(silence), end});
        EXPECT_FALSE(ended == course_of(with(world, {silence})));
        silence.duration = lasts;
        EXPECT_TRUE(ended == course_of(with(world, {silence}))) << seed;
      }
    }
  }
}

TEST_P(Interventions, AnEndOfOneSilenceIsNoEndOfAnotherSensorsSilence) {
  const worlds::World world = world_of(GetParam(), 1);
  Fault silence = fault_of(FaultKind::silence, on_a_scan);
  silence.sensor = FaultySensor::encoders;
  silence.duration = worlds::open_end;
  const Deed end{7.0,
                 [](SimulatedStream& stream) { stream.end_silence(FaultySensor::landmark_sensor, 7.0); }};
  EXPECT_TRUE(course_with(world, {injection_of(silence), end}) == course_of(with(world, {silence})));
}

/// How often each landmark is seen in the rest of a run; each must be seen where the description says that it is.
std::vector<int> sightings_in(SimulatedStream& stream) {
  const std::vector<TrueLandmark>& landmarks = *stream.description().landmarks;
  std::vector<int> sightings(landmarks.size());
  Event event;
  while (stream.next(event)) {
    const auto* scan = std::get_if<ScanEvent>(&event);
    if (scan == nullptr) continue;
    const seif::Pose2 T_world_sensor = scan->truth->T_world_robot * stream.description().T_robot_sensor;
    for (const seif::Observation& o : scan->scan.observations) {
      const auto id = static_cast<std::size_t>(o.landmark);
      const Eigen::Vector2d p_sensor(o.range * std::cos(o.bearing), o.range * std::sin(o.bearing));
      EXPECT_LT((T_world_sensor * p_sensor - landmarks.at(id).position).norm(), 1.0) << id;
      ++sightings.at(id);
    }
  }
  return sightings;
}

TEST_P(Interventions, ALandmarkThatAppearsIsSeenWithTheNextId) {
  const worlds::World world = world_of(GetParam(), 1);
  const Fault fault = fault_of(FaultKind::landmark, between_readings);
  SimulatedStream stream(world, {});
  Event event;
  while (stream.next_step_t() < fault.at) stream.advance(event);
  stream.inject(fault);
  EXPECT_EQ(stream.description().landmarks->back().landmark, 12);
  EXPECT_EQ(stream.description().landmarks->back().position, fault.landmark.position);
  EXPECT_GT(sightings_in(stream).at(12), 5);
}

// Two of the same step of the physics, the later one first in the file.
TEST_P(Interventions, LandmarksOfOneStepGetTheirIdsInTheOrderOfTime) {
  std::vector<Fault> faults = {fault_of(FaultKind::landmark, 5.003), fault_of(FaultKind::landmark, 5.001)};
  faults.back().landmark.position = {1.0, 1.0};
  SimulatedStream stream(with(world_of(GetParam(), 1), faults), {});
  EXPECT_EQ(stream.description().landmarks->at(12).position, Eigen::Vector2d(1.0, 1.0));
  const std::vector<int> sightings = sightings_in(stream);
  EXPECT_GT(sightings.at(12), 5);
  EXPECT_GT(sightings.at(13), 5);
}

// Ids follow the order of time: what is injected comes before what the file has for later.
TEST_P(Interventions, ALandmarkInjectedBeforeOneOfTheFileGetsTheIdBefore) {
  Fault of_the_file = fault_of(FaultKind::landmark, 8.0);
  of_the_file.landmark.position = {4.6, -2.0};
  const worlds::World world = with(world_of(GetParam(), 3), {of_the_file});
  const Fault injected = fault_of(FaultKind::landmark, between_readings);
  const Course course = course_with(world, {injection_of(injected)});
  ASSERT_EQ(course.landmarks.size(), 14U);
  EXPECT_EQ(course.landmarks[12].position, injected.landmark.position);
  EXPECT_EQ(course.landmarks[13].position, of_the_file.landmark.position);
  EXPECT_TRUE(course == course_of(with(world, {injected})));
}

TEST_P(Interventions, LandmarksOfTheFileAreDescribedFromTheStartInTheOrderOfTime) {
  std::vector<Fault> faults;
  for (const double at : {9.0, 4.0, 9.0, 1.0}) {
    Fault fault = fault_of(FaultKind::landmark, at);
    fault.landmark.position = {-15.0, static_cast<double>(faults.size())};
    faults.push_back(fault);
  }
  const SimulatedStream stream(with(world_of(GetParam(), 1), faults), {});
  const std::vector<TrueLandmark>& landmarks = *stream.description().landmarks;
  ASSERT_EQ(landmarks.size(), 16U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(landmarks[12 + i].landmark, static_cast<seif::LandmarkId>(12 + i));
    EXPECT_EQ(landmarks[12 + i].position.y(),
              std::vector({3.0, 1.0, 0.0, 2.0})[i]);  // equal times: of the file
  }
}

TEST_P(Interventions, WhatIsRefusedLeavesNoTrace) {
  const worlds::World world = world_of(GetParam(), 4);
  const auto refused = [](SimulatedStream& stream, const Fault& fault) {
    EXPECT_THROW(stream.inject(fault), std::invalid_argument) << static_cast<int>(fault.kind);
  };
  const Deed deed{on_a_scan, [&](SimulatedStream& stream) {
                    const double t = stream.next_step_t();
                    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
                    for (const double early : {0.0, t - stream.step_s(), nan}) {
                      refused(stream, fault_of(FaultKind::outlier, early));
                      EXPECT_THROW(stream.take_over({early, true, 0.0, 0.0}), std::invalid_argument);
                      EXPECT_THROW(stream.end_silence(FaultySensor::encoders, early), std::invalid_argument);
                    }
                    refused(stream, fault_of(FaultKind::option, t));
                    Fault fault = fault_of(FaultKind::kidnapping, t);
                    fault.to.position = world.landmarks.front().position;
                    refused(stream, fault);
                    fault = fault_of(FaultKind::landmark, t);
                    fault.landmark.position = {21.0, 0.0};
                    refused(stream, fault);
                    fault.landmark.position = stream.robot().position;
                    refused(stream, fault);
                    if (GetParam() == Engine::kinematic) {
                      refused(stream, fault_of(FaultKind::ice, t));
                      refused(stream, fault_of(FaultKind::wall, t));
                    }
                  }};
  EXPECT_TRUE(course_with(world, {deed}) == course_of(world));
}

TEST_P(Interventions, NoLandmarkAppearsWhereTheNextIdsAreThoseOfFalseDetections) {
  worlds::World world = world_of(GetParam(), 1);
  world.landmark_sensor.false_detections = 0.5;
  SimulatedStream stream(world, {});
  EXPECT_THROW(stream.inject(fault_of(FaultKind::landmark, 1.0)), std::invalid_argument);
}

TEST_P(Interventions, WhatTheFilePutsOnTheRobotEndsTheRunWithTheReason) {
  Fault fault = fault_of(FaultKind::landmark, 0.5);
  fault.landmark = {{3.0, -2.8}, 0.2};
  try {
    course_of(with(world_of(GetParam(), 1), {fault}));
    FAIL() << "it appeared";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "at 0.5 s: the landmark of the world's faults cannot appear: there is no room: the robot "
              "stands there");
  }
}

TEST_P(Interventions, ATakeoverGivesTheBitsOfItsFile) {
  const std::vector<Takeover> rows = {
      {on_a_scan, false, 0.3, 0.8}, {between_readings, false, -0.2, 0.1}, {7.0 + 1.0 / 240.0, true, 0.0, 0.0},
      {9.0, false, 0.0, -0.5},      {9.0 + 1.0 / 240.0, false, 0.1, 0.5}, {11.0, true, 0.0, 0.0}};
  for (const worlds::DriveMode mode : {worlds::DriveMode::loop, worlds::DriveMode::explore,
                                       worlds::DriveMode::hold, worlds::DriveMode::commands}) {
    for (const std::uint64_t seed : seeds) {
      worlds::World world = world_of(GetParam(), seed);
      world.drive.mode = mode;
      world.drive.commands = {{1.0, 0.3, 0.1}, {8.0, 0.1, 0.1}};
      std::vector<Deed> deeds;
      for (const Takeover& row : rows) deeds.push_back(takeover_by(row));
      const Course plain = course_of(world);
      const Course by_hand = course_with(world, deeds);
      world.drive.takeover = rows;
      EXPECT_TRUE(by_hand == course_of(world)) << "seed " << seed << ", mode " << static_cast<int>(mode);
      EXPECT_FALSE(by_hand == plain);
    }
  }
}

TEST_P(Interventions, WhoeverTakesTheWheelMovesTheRobotUntilItIsGivenBack) {
  worlds::World world = world_of(GetParam(), 1);
  world.drive.takeover = {{2.0, false, 0.0, 0.0}, {6.0, false, -0.4, 0.0}, {8.0, true, 0.0, 0.0}};
  SimulatedStream stream(world, {});
  Event event;
  const auto speed_at = [&](double t) {
    while (stream.next_step_t() < t) stream.advance(event);
    return stream.robot().v;
  };
  EXPECT_NEAR(speed_at(2.0), 0.6, 0.02);
  EXPECT_NEAR(speed_at(3.5), 0.0, 0.01);
  EXPECT_NEAR(speed_at(5.9), 0.0, 0.01);
  EXPECT_NEAR(speed_at(7.5), -0.4, 0.02);
  EXPECT_NEAR(speed_at(11.0), 0.6, 0.02);
}

// The command acts at the very next step, not at the next odometry.
TEST_P(Interventions, ATakeoverActsAtTheStepOfItsTime) {
  worlds::World world = world_of(GetParam(), 1);
  world.encoders.rate = 1;
  world.drive.takeover = {{between_readings, false, 0.0, 0.0}};
  SimulatedStream stream(world, {});
  Event event;
  while (stream.next_step_t() < between_readings + 0.5 * stream.step_s()) stream.advance(event);
  const double before = stream.robot().v;
  while (stream.next_step_t() < between_readings + 60.5 * stream.step_s()) stream.advance(event);
  EXPECT_NEAR(before, 0.6, 0.02);
  EXPECT_NEAR(stream.robot().v, 0.6 - 60.0 / 240.0 * world.robot.max_acceleration, 0.02);
}

TEST_P(Interventions, ARowBeforeThoseOfTheFileComesBeforeThemAndOneOfTheSameTimeInTheirPlace) {
  worlds::World world = world_of(GetParam(), 5);
  world.drive.takeover = {{2.0, false, 0.2, 0.2}, {8.0, false, 0.0, 0.3}, {10.0, true, 0.0, 0.0}};
  const Course by_hand = course_with(
      world, {takeover_by({on_a_scan, false, 0.5, -0.3}), {6.0, [](SimulatedStream& stream) {
                                                             stream.take_over({9.0, false, 0.4, 0.4});
                                                             stream.take_over({8.0, false, 0.1, 0.1});
                                                             stream.take_over({9.0, false, 0.2, -0.4});
                                                           }}});
  world.drive.takeover = {{2.0, false, 0.2, 0.2},
                          {on_a_scan, false, 0.5, -0.3},
                          {8.0, false, 0.1, 0.1},
                          {9.0, false, 0.2, -0.4},
                          {10.0, true, 0.0, 0.0}};
  EXPECT_TRUE(by_hand == course_of(world));
}

TEST_P(Interventions, AnExtendedRunIsALongerOne) {
  worlds::World world = world_of(GetParam(), 1);
  world.duration = 5.0;
  SimulatedStream stream(world, {});
  Event event;
  Course course;
  while (stream.next(event)) course.events.push_back(bits_of(event));
  stream.extend(7.0);
  const Course rest = rest_of(stream);
  course.events.insert(course.events.end(), rest.events.begin(), rest.events.end());
  world.duration = 12.0;
  EXPECT_TRUE(course.events == course_of(world).events);
}

TEST_P(Interventions, AdvanceGoesOneStepAtATime) {
  SimulatedStream stream(world_of(GetParam(), 1), {});
  Event event;
  std::int64_t steps = 0;
  for (auto done = stream.advance(event); done != SimulatedStream::Advance::end;
       done = stream.advance(event)) {
    if (done == SimulatedStream::Advance::step) ++steps;
    ASSERT_EQ(stream.physics_steps(), steps);
    ASSERT_EQ(stream.next_step_t(), static_cast<double>(steps + 1) / 240.0);
  }
  EXPECT_EQ(steps, 12 * 240);
}

TEST_P(Interventions, ThatAreOverLeaveARunThatAllocatesNothing) {
  if (COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "the sanitizer has a malloc of its own";
  std::vector<Fault> faults;
  for (const FaultKind kind : kinds_in(GetParam())) {
    if (kind != FaultKind::wall && kind != FaultKind::ice) faults.push_back(fault_of(kind, on_a_scan));
  }
  worlds::World world = with(world_of(GetParam(), 1), faults);
  world.duration = 240.0;
  for (int i = 0; i < 200; ++i) world.drive.takeover.push_back({10.0 + i, i % 2 == 1, 0.3, 0.1});
  SimulatedStream stream(world, {});
  Event event;
  long early = 0;
  while (stream.next(event)) {
    if (stream.next_step_t() < 140.0) early = allocations();
  }
  EXPECT_EQ(allocations(), early);
}

TEST(InterventionsInBullet, IceLetsTheRobotSlideOn) {
  worlds::World world = world_of(Engine::bullet, 1);
  world.drive.takeover = {{6.0, false, 0.0, 0.0}};
  const Course dry = course_of(world);
  const Course slid = course_of(with(world, {fault_of(FaultKind::ice, on_a_scan)}));
  EXPECT_GT(slid.robot.position.y() - dry.robot.position.y(), 0.5);
}

TEST(InterventionsInBullet, AWallStopsTheRobotAndHidesLandmarks) {
  worlds::World world = world_of(Engine::bullet, 1);
  world.landmarks.push_back({{3.2, 5.0}, 0.1});
  const Fault wall = fault_of(FaultKind::wall, on_a_scan);
  SimulatedStream stream(with(world, {wall}), {});
  Event event;
  int seen_before = 0;
  while (stream.next(event)) {
    const auto* scan = std::get_if<ScanEvent>(&event);
    if (scan == nullptr) continue;
    for (const seif::Observation& o : scan->scan.observations) {
      if (o.landmark != 12) continue;
      EXPECT_LE(scan->scan.t, wall.at);
      ++seen_before;
    }
  }
  EXPECT_GT(seen_before, 5);
  EXPECT_LT(stream.robot().position.y(), 2.4);
  EXPECT_GT(course_of(world).robot.position.y(), 2.8);
}

TEST(InterventionsInBullet, AWallOnTheRobotOfAFileEndsTheRunWithTheReason) {
  Fault fault = fault_of(FaultKind::wall, 0.0);
  fault.wall.points = {{2.0, -3.1}, {4.0, -3.1}};
  try {
    course_of(with(world_of(Engine::bullet, 1), {fault}));
    FAIL() << "it appeared";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "at 0 s: the wall of the world's faults cannot appear: there is no room: the robot stands there");
  }
}

// A wall is refused or appears: whatever is not refused does not end the run. Corners of walls are filled.
TEST(InterventionsInBullet, WhatIsNotRefusedAppears) {
  const worlds::World world = world_of(Engine::bullet, 1);
  int refused = 0;
  int appeared = 0;
  for (double ahead = 0.3; ahead < 1.2; ahead += 0.02) {
    for (const bool is_corner : {false, true}) {
      SimulatedStream stream(world, {});
      Event event;
      while (stream.next_step_t() < on_a_scan) stream.advance(event);
      const Eigen::Vector2d p = stream.robot().position + ahead * Eigen::Vector2d(is_corner ? 1.0 : 0.0, 1.0);
      Fault fault = fault_of(FaultKind::wall, on_a_scan);
      fault.wall.thickness = 0.8;
      fault.wall.points = {p - Eigen::Vector2d(2.0, 0.0), p + Eigen::Vector2d(2.0, 0.0)};
      if (is_corner) fault.wall.points = {p + Eigen::Vector2d(0.0, 3.0), p, p + Eigen::Vector2d(3.0, 0.0)};
      try {
        stream.inject(fault);
      } catch (const std::invalid_argument&) {
        ++refused;
        continue;
      }
      ++appeared;
      EXPECT_NO_THROW(while (stream.next_step_t() < on_a_scan + 0.05) stream.advance(event)) << ahead;
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(appeared, 20);
}

TEST(InterventionsInBullet, AWallThatAppearedLeavesNoRoomForWhoIsPutThere) {
  SimulatedStream stream(world_of(Engine::bullet, 1), {});
  Event event;
  Fault wall = fault_of(FaultKind::wall, 1.0);
  wall.wall.points = {{-4.0, -1.0}, {0.0, -1.0}};
  stream.inject(wall);
  while (stream.next_step_t() < 2.0) stream.advance(event);
  EXPECT_THROW(stream.inject(fault_of(FaultKind::kidnapping, 2.0)), std::invalid_argument);
}

}  // namespace
}  // namespace harness
