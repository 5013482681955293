// Data association: pairs the observations of a scan with landmarks.
//
// One pair is compatible if v' S^-1 v of its innovation v is inside the chi-square gate of two degrees of
// freedom. A hypothesis of k pairs is compatible if v' S^-1 v of all innovations together is inside the gate of 2k
// degrees of freedom: the innovations are correlated, because they share the pose. Neira, Tardos, "Data
// association in stochastic mapping using the joint compatibility test", IEEE Transactions on Robotics and
// Automation 17(6), 2001.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "seif/models.hpp"

namespace seif {

/// The value that a chi-square variable of 2 `pairs` degrees of freedom exceeds with this probability. [-]
double chi_square_gate(int pairs, double probability);

/// v' P^-1 v, [-], for two landmarks that lie v [m] apart. P is the covariance of v, from the joint covariance `Sigma`;
/// there the landmarks have the rows from `row_a` and from `row_b` on.
double squared_distance_apart(const Eigen::Ref<const Eigen::MatrixXd>& Sigma, Eigen::Index row_a,
                              Eigen::Index row_b, const Eigen::Vector2d& v);

/// The observation that a filter expects of a landmark.
struct ExpectedObservation {
  Eigen::Vector2d v = Eigen::Vector2d::Zero();    // innovation [m, rad]
  Matrix23 J_x = Matrix23::Zero();                // (2 x 3) wrt the pose
  Eigen::Matrix2d J_m = Eigen::Matrix2d::Zero();  // (2 x 2) wrt the landmark
};

/// An observation and a candidate landmark.
struct Candidate {
  int observation = 0;  // its number in the scan
  int landmark = 0;     // its number in the joint covariance
  ExpectedObservation expected;
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();  // (2 x 2) covariance of v
  double squared_distance = 0.0;                // [-] v' S^-1 v
  double cost = 0.0;                            // [-] twice its negative log-likelihood, but for a constant
};

/// Finds the pairs of one scan after another. Keeps its memory, so that no scan allocates in the steady state.
class ScanMatcher {
 public:
  static constexpr int none = -1;

  /// A correct pair is rejected with probability `match_probability`, and its observation is taken for a new landmark
  /// with at most `new_probability`. The search for joint pairs ends after `most_steps`, with the best so far.
  ScanMatcher(double match_probability, double new_probability, int most_steps = 2000);

  /// `Sigma` is the covariance of [pose | landmarks] (3+2m x 3+2m), and must live until the end of
  /// the scan.
  void begin(int observations, const Eigen::Ref<const Eigen::MatrixXd>& Sigma);
  /// Adds a candidate pair; `Q` is the covariance of the observation. Returns its v' S^-1 v.
  double add(int observation, int landmark, const ExpectedObservation& expected, const Eigen::Matrix2d& Q);

  /// Chooses the most likely compatible pairs first, each observation and each landmark at most once.
  void match_nearest();
  /// Chooses the largest set of pairs that are compatible together; of equally large sets the one with the least
  /// distance.
  void match_jointly();

  /// The landmark that an observation was paired with, or none.
  int match(int observation) const { return match_[static_cast<std::size_t>(observation)]; }
  bool all_matched() const { return std::ranges::find(match_, none) == match_.end(); }
  /// Whether an unpaired observation may still be of a landmark, given all pairs: of an unpaired one, or as a second
  /// observation of a paired one.
  bool may_be_known(int observation);
  double gate() const { return gate(1); }  // [-] of one pair
  double widest_gate() const { return std::max(far_, gate(1)); }
  /// Those that may be, by `new_probability`.
  std::span<const Candidate> candidates() const { return candidates_; }

 private:
  struct Best {
    int pairs = -1;
    double squared_distance = 0.0;
    std::vector<int> chosen;
  };

  void sort_candidates();
  void search(std::size_t level, int pairs, double squared_distance);
  bool is_worth(int pairs, double squared_distance) const;
  void cross_covariances(const Candidate& candidate, int pairs);
  bool condition(const Candidate& candidate, int pairs, Eigen::Vector2d& v, Eigen::Matrix2d& S);
  double extend(int candidate, int pairs);
  void take(std::span<const int> chosen);
  void reserve(std::size_t observations);
  const Candidate& candidate(int i) const { return candidates_[static_cast<std::size_t>(i)]; }
  double gate(int pairs) const { return gates_[static_cast<std::size_t>(pairs)]; }
  bool is_compatible(const Candidate& candidate) const { return candidate.squared_distance <= gate(1); }

  double far_;  // [-] squared distance beyond which a landmark is another one
  int most_steps_;
  int steps_ = 0;
  std::vector<double> gates_;  // by number of pairs
  Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> Sigma_{nullptr, 0, 0, Eigen::OuterStride<>(0)};
  std::vector<Candidate> candidates_;
  std::vector<int> match_;          // by observation
  std::vector<int> first_, order_;  // by observation: the first of its candidates; those that have some
  std::vector<int> chosen_;         // by level: a candidate or none
  std::vector<int> pairs_;          // candidates of the hypothesis, as far as L_ goes
  std::vector<char> taken_;         // by landmark
  Best best_;
  Eigen::MatrixXd responses_;  // by candidate: Sigma [J_x J_m]' (3+2m x 2), with room to grow, as all below
  Eigen::MatrixXd L_;          // of the covariance of the innovations of pairs_
  Eigen::VectorXd y_;          // L^-1 v
  Eigen::Matrix<double, Eigen::Dynamic, 2> cross_;  // (2k x 2)
};

}  // namespace seif
