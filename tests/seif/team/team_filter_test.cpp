// Robots that tell each other what they learn end with the map of one that has measured it all.
#include "seif/team/team_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "seif/relocating/rigid_fit.hpp"
#include "seif/team/packet.hpp"
#include "two_robots.hpp"

namespace seif {
namespace {

using test::PathDrive;
using test::Points;
using test::Teammate;

using Packets = std::vector<std::vector<std::byte>>;

const Points way = {{0, 0}, {30, 0}, {30, 20}, {0, 20}, {0, 0}, {30, 0}};
const Points other_way = {{30, 20}, {0, 20}, {0, 0}, {30, 0}, {30, 20}, {0, 20}};
constexpr TeamOptions often{.tell_after = 10, .listen_after = 5};

std::vector<Teammate> two_robots(unsigned seed, const SeifOptions& options = {}) {
  const Points landmarks = test::landmarks_along(way, 3);
  std::vector<Teammate> team;
  team.emplace_back(PathDrive(landmarks, way, seed), often, seed, options);
  team.emplace_back(PathDrive(landmarks, other_way, seed + 1000), often, seed + 1000, options);
  for (std::size_t i = 0; i < team.size(); ++i) team[i].filter->enter_team(i, team.size());
  return team;
}

/// All packets with pieces that a robot has to send.
Packets all_pieces(TeamFilter& filter, const std::vector<std::byte>& beacon_of_other, double t) {
  Packets packets;
  std::vector<std::byte> packet;
  filter.hear(t, beacon_of_other);
  while (filter.speak(t, packet)) packets.push_back(packet);
  return packets;
}

void stand(TeamFilter& filter, int updates) {
  for (int k = 0; k < updates; ++k)
    filter.measurement_update({.t = 1000.0 + k, .observations = {}}, [](Stage) {});
}

std::vector<Eigen::Vector2d> places(const Estimator& filter) {
  std::vector<LandmarkEstimate> map = filter.map();
  std::ranges::sort(map, {}, &LandmarkEstimate::landmark);
  std::vector<Eigen::Vector2d> all;
  for (const LandmarkEstimate& landmark : map) all.push_back(landmark.mean);
  return all;
}

double largest_distance(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

TEST(TeamFilter, KeepsTheInvariantsOfItsTree) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SeifOptions options;
    if (seed == 2) options.tree.most_blocks = 0;  // each plan at once
    if (seed == 3) options.tree.most_blocks = 300;
    if (seed == 4) options.tree.most_unknowns = 40;
    std::vector<Teammate> team = two_robots(seed, options);
    for (int k = 0; !team[0].drive.at_end() || !team[1].drive.at_end(); ++k) {
      for (Teammate& robot : team) robot.advance();
      test::talk(team, k);
      for (const Teammate& robot : team)
        ASSERT_EQ(robot.filter->news().broken_invariant(), std::nullopt) << seed << " update " << k;
    }
    for (const Teammate& robot : team) EXPECT_GT(robot.filter->team_counts().learnt_pieces, 0);
  }
}

TEST(TeamFilter, AloneIsASeif) {
  const Points landmarks = test::landmarks_along(way, 3);
  std::vector<Teammate> team;
  team.emplace_back(PathDrive(landmarks, way, 1), often, 1);
  team.front().filter->enter_team(0, 2);  // whom it never meets
  PathDrive drive(landmarks, way, 1);
  Seif seif(test::with_error_of_start(drive.setup(), 1), {});
  while (team.front().advance()) {
    drive.advance();
    seif.motion_update(drive.odometry());
    seif.measurement_update(drive.scan(), [](Stage) {});
  }
  EXPECT_GT(team.front().filter->team_counts().told_pieces, 5);
  EXPECT_EQ(team.front().filter->pose().x, seif.pose().x);
  EXPECT_EQ(largest_distance(places(*team.front().filter), places(seif)), 0.0);
}

/// What two robots know that have driven alone, in one matrix.
struct Oracle {
  Eigen::MatrixXd Omega;  // over [pose of the first robot | landmarks], where they are
  Eigen::VectorXd mu;
  std::vector<LandmarkId> landmarks;

  explicit Oracle(const Estimator& alone) : Omega(alone.whole_belief_matrix()), mu(Omega.rows()) {
    mu.head<3>() << alone.pose().x, alone.pose().y, alone.pose().theta;
    for (const LandmarkEstimate& landmark : alone.map()) {
      mu.segment<2>(row(landmarks.size())) = landmark.mean;
      landmarks.push_back(landmark.landmark);
    }
  }

  static Eigen::Index row(std::size_t i) { return 3 + static_cast<Eigen::Index>(2 * i); }
  std::size_t index(LandmarkId id) const {
    return static_cast<std::size_t>(std::ranges::find(landmarks, id) - landmarks.begin());
  }
  Eigen::Vector2d place(LandmarkId id) const { return mu.segment<2>(row(index(id))); }

  /// The piece where its known landmarks are.
  TeamPiece placed(const TeamPiece& piece) const {
    std::vector<Eigen::Vector2d> told, known;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      if (index(piece.landmarks[i]) == landmarks.size()) continue;
      told.push_back(piece.references[i]);
      known.push_back(place(piece.landmarks[i]));
    }
    return moved(rigid_fit(told, known).value(), piece);
  }

  void enter(const TeamPiece& piece) {
    const TeamPiece here = placed(piece);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (index(here.landmarks[i]) < landmarks.size()) continue;
      landmarks.push_back(here.landmarks[i]);
      const Eigen::Index n = mu.size();
      mu.conservativeResize(n + 2);
      mu.tail<2>() = here.references[i];
      Omega.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 2, n + 2));
    }
  }

  /// Adds all pieces exactly: matrices side by side, landmarks of one name as one, linearised until nothing moves.
  void solve(const std::vector<TeamPiece>& pieces) {
    const Eigen::VectorXd alone = mu;
    for (int k = 0; k < 10; ++k) {
      Eigen::MatrixXd sum = Omega;
      Eigen::VectorXd r = Omega * (alone - mu);
      for (const TeamPiece& piece : pieces) add(placed(piece), sum, r);
      mu += Eigen::LDLT<Eigen::MatrixXd>(sum).solve(r);
    }
  }

  void add(const TeamPiece& here, Eigen::MatrixXd& sum, Eigen::VectorXd& r) const {
    Eigen::VectorXd d(here.r.size());
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Eigen::Index at = row(index(here.landmarks[i]));
      rows.insert(rows.end(), {at, at + 1});
      d.segment<2>(static_cast<Eigen::Index>(2 * i)) = place(here.landmarks[i]) - here.references[i];
    }
    sum(rows, rows) += here.Omega;
    r(rows) += here.r - here.Omega * d;
  }
};

/// The first robot drives one side of the square, the second all of it, and neither hears anything.
std::vector<Teammate> strangers() {
  const Points landmarks = test::landmarks_along(way, 3);
  std::vector<Teammate> team;
  team.emplace_back(PathDrive(landmarks, {{0, 0}, {12, 0}}, 4), often, 4);
  team.emplace_back(PathDrive(landmarks, other_way, 5), often, 5);
  for (std::size_t i = 0; i < team.size(); ++i) {
    team[i].filter->enter_team(i, team.size());
    while (team[i].advance()) continue;
  }
  return team;
}

Packets pieces_of_second(std::vector<Teammate>& team) {
  std::vector<std::byte> beacon;
  team[0].filter->speak(0.0, beacon);
  return all_pieces(*team[1].filter, beacon, 0.0);
}

TEST(TeamFilter, JoinsTwoMapsAsTheSumOfTheirMatricesDoes) {
  std::vector<Teammate> team = strangers();
  Oracle oracle(*team[0].filter);
  const Packets packets = pieces_of_second(team);
  std::vector<TeamPiece> pieces;
  for (const std::vector<std::byte>& bytes : packets) {
    team[0].filter->hear(0.0, bytes);
    const std::optional<Packet> packet = open_packet(bytes, 2);
    if (packet->is_beacon) continue;
    pieces.push_back(decode(packet->piece).value());
  }
  ASSERT_GT(pieces.size(), 10U);
  stand(*team[0].filter, 400);
  ASSERT_EQ(team[0].filter->team_counts().learnt_pieces, static_cast<int>(pieces.size()));
  std::vector<TeamPiece> waiting = pieces;
  for (std::size_t k = 0; k < 10 * pieces.size() && !waiting.empty(); ++k) {
    std::ranges::rotate(waiting, waiting.begin() + 1);
    const auto is_known = [&](LandmarkId id) { return oracle.index(id) < oracle.landmarks.size(); };
    if (std::ranges::count_if(waiting.back().landmarks, is_known) < 3) continue;
    oracle.enter(waiting.back());
    waiting.pop_back();
  }
  ASSERT_TRUE(waiting.empty());
  oracle.solve(pieces);
  double largest = 0.0;
  for (const LandmarkEstimate& landmark : team[0].filter->map())
    largest = std::max(largest, (oracle.place(landmark.landmark) - landmark.mean).norm());
  // The farthest landmarks are 40 m away. The oracle keeps the first map linearised as it was, the filter does not.
  EXPECT_LT(largest, 5e-3);
}

TEST(TeamFilter, LearnsThatWhichItHearsTenTimesOnce) {
  std::vector<Teammate> once = strangers();
  std::vector<Teammate> often_told = strangers();
  const Packets packets = pieces_of_second(once);
  for (int k = 0; k < 10; ++k) {
    for (const std::vector<std::byte>& packet : packets) {
      if (k == 0) once[0].filter->hear(0.0, packet);
      often_told[0].filter->hear(0.0, packet);
    }
    stand(*once[0].filter, 40);
    stand(*often_told[0].filter, 40);
  }
  EXPECT_GT(places(*once[0].filter).size(), 60U);
  EXPECT_EQ(largest_distance(places(*once[0].filter), places(*often_told[0].filter)), 0.0);
  EXPECT_EQ(once[0].filter->team_counts().learnt_pieces, often_told[0].filter->team_counts().learnt_pieces);
}

TEST(TeamFilter, HasTheSameMapInWhicheverOrderNewsCome) {
  std::vector<Teammate> forward = strangers();
  std::vector<Teammate> backward = strangers();
  Packets packets = pieces_of_second(forward);
  for (const std::vector<std::byte>& packet : packets) forward[0].filter->hear(0.0, packet);
  std::ranges::reverse(packets);
  for (const std::vector<std::byte>& packet : packets) backward[0].filter->hear(0.0, packet);
  for (Teammate* robot : {&forward[0], &backward[0]}) stand(*robot->filter, 600);
  ASSERT_EQ(places(*forward[0].filter).size(), places(*backward[0].filter).size());
  EXPECT_EQ(largest_distance(places(*forward[0].filter), places(*backward[0].filter)), 0.0);
}

/// The squared error over the covariance that the filter states, for each degree of freedom: of poses and of landmarks.
struct Nees {
  double pose = 0.0, landmarks = 0.0;
};

Nees nees(const Teammate& robot, const Points& truth) {
  const Estimator& filter = *robot.filter;
  std::vector<LandmarkId> ids;
  for (const LandmarkEstimate& landmark : filter.map()) ids.push_back(landmark.landmark);
  const MarginalCovariances covariances = filter.marginal_covariances(ids).value();
  Nees nees;
  const Pose2 at = filter.pose();
  const Pose2 true_pose = robot.drive.truth();
  const Eigen::Vector3d error(at.x - true_pose.x, at.y - true_pose.y, wrap_angle(at.theta - true_pose.theta));
  nees.pose = error.dot(covariances.pose.inverse() * error) / 3.0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Eigen::Vector2d d = filter.map()[i].mean - truth[static_cast<std::size_t>(ids[i])];
    nees.landmarks += d.dot(covariances.landmarks[i].inverse() * d) / (2.0 * static_cast<double>(ids.size()));
  }
  return nees;
}

TEST(TeamFilter, IsConsistentAfterManyExchanges) {
  constexpr int seeds = 20;
  const Points landmarks = test::landmarks_along(way, 3);
  Nees mean;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::vector<Teammate> team = two_robots(seed);
    for (int k = 0; !team[0].drive.at_end() || !team[1].drive.at_end(); ++k) {
      for (Teammate& robot : team) robot.advance();
      test::talk(team, k);
    }
    for (const Teammate& robot : team) {
      const Nees of_robot = nees(robot, landmarks);
      mean.pose += of_robot.pose / (2 * seeds);
      mean.landmarks += of_robot.landmarks / (2 * seeds);
    }
  }
  EXPECT_GT(mean.pose, 0.8);
  EXPECT_LT(mean.pose, 1.3);
  EXPECT_GT(mean.landmarks, 0.7);
  EXPECT_LT(mean.landmarks, 1.4);
}

TEST(TeamFilter, BearsAnyBytes) {
  std::vector<Teammate> team = strangers();
  const Packets packets = pieces_of_second(team);
  std::mt19937 random(1);
  for (const std::vector<std::byte>& packet : packets) {
    for (std::size_t size : {std::size_t{0}, packet.size() / 2, packet.size() - 1})
      team[0].filter->hear(0.0, std::span(packet).first(size));
    std::vector<std::byte> noise = packet;
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    team[0].filter->hear(0.0, noise);
  }
  EXPECT_EQ(team[0].filter->team_counts().heard_pieces, 0);
}

}  // namespace
}  // namespace seif
