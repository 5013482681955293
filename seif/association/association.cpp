#include "seif/association/association.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace seif {
namespace {

constexpr std::size_t most_pairs = 64;  // [-] in one hypothesis; observations beyond have no pair

/// Q(x) = exp(-x/2) sum_{i < pairs} (x/2)^i / i!, which holds for even degrees of freedom.
double chi_square_tail(int pairs, double x) {
  double term = std::exp(-0.5 * x);
  double sum = 0.0;
  for (int i = 0; i < pairs; ++i) {
    sum += term;
    term *= 0.5 * x / (i + 1);
  }
  return sum;
}

}  // namespace

double chi_square_gate(int pairs, double probability) {
  double low = 0.0;
  double high = 1.0;
  while (chi_square_tail(pairs, high) > probability) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_tail(pairs, middle) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double squared_distance_apart(const Eigen::Ref<const Eigen::MatrixXd>& Sigma, Eigen::Index row_a,
                              Eigen::Index row_b, const Eigen::Vector2d& v) {
  const Eigen::Matrix2d P = Sigma.block<2, 2>(row_a, row_a) + Sigma.block<2, 2>(row_b, row_b) -
                            Sigma.block<2, 2>(row_a, row_b) - Sigma.block<2, 2>(row_b, row_a);
  return v.dot(P.inverse() * v);
}

ScanMatcher::ScanMatcher(double match_probability, double new_probability, int most_steps)
    : far_(chi_square_gate(1, new_probability)), most_steps_(most_steps) {
  for (std::size_t pairs = 0; pairs <= most_pairs; ++pairs)
    gates_.push_back(pairs == 0 ? 0.0 : chi_square_gate(static_cast<int>(pairs), match_probability));
  candidates_.reserve(4 * most_pairs);
  match_.reserve(most_pairs);
  taken_.reserve(4 * most_pairs);
  for (auto* numbers : {&first_, &order_, &chosen_, &pairs_, &best_.chosen}) numbers->reserve(most_pairs);
  responses_.resize(2 * most_pairs, 8 * most_pairs);
}

void ScanMatcher::reserve(std::size_t observations) {
  const auto rows = static_cast<Eigen::Index>(2 * std::min(observations, most_pairs));
  if (L_.rows() >= rows) return;
  L_.resize(2 * rows, 2 * rows);
  y_.resize(2 * rows);
  cross_.resize(2 * rows, 2);
}

void ScanMatcher::begin(int observations, const Eigen::Ref<const Eigen::MatrixXd>& Sigma) {
  new (&Sigma_) decltype(Sigma_)(Sigma.data(), Sigma.rows(), Sigma.cols(),
                                 Eigen::OuterStride<>(Sigma.outerStride()));
  candidates_.clear();
  pairs_.clear();
  match_.assign(static_cast<std::size_t>(observations), none);
  taken_.assign(static_cast<std::size_t>(Sigma.rows() / 2), 0);
  reserve(match_.size());
}

double ScanMatcher::add(int observation, int landmark, const ExpectedObservation& expected,
                        const Eigen::Matrix2d& Q) {
  const Eigen::Index n = Sigma_.rows();
  const auto col = static_cast<Eigen::Index>(2 * candidates_.size());
  if (responses_.rows() < n || responses_.cols() < col + 2)
    responses_.conservativeResize(std::max(2 * n, responses_.rows()),
                                  std::max(2 * col + 2, responses_.cols()));
  const int row = 3 + 2 * landmark;
  auto response = responses_.middleCols<2>(col).topRows(n);
  // Lazy, here and below: Eigen's other products ask for memory.
  response = Sigma_.leftCols<3>().lazyProduct(expected.J_x.transpose());
  response += Sigma_.middleCols<2>(row).lazyProduct(expected.J_m.transpose());
  Candidate candidate{.observation = observation, .landmark = landmark, .expected = expected};
  candidate.S = expected.J_x * response.topRows<3>() + expected.J_m * response.middleRows<2>(row) + Q;
  if (!(candidate.S(0, 0) > 0.0 && candidate.S.determinant() > 0.0))
    return std::numeric_limits<double>::infinity();
  candidate.squared_distance = expected.v.dot(candidate.S.inverse() * expected.v);
  candidate.cost = candidate.squared_distance + std::log(candidate.S.determinant());
  // Written so that what is not a number is no candidate either.
  if (candidate.squared_distance <= widest_gate()) candidates_.push_back(candidate);
  return candidate.squared_distance;
}

void ScanMatcher::match_nearest() {
  while (true) {
    const Candidate* best = nullptr;
    for (const Candidate& c : candidates_) {
      if (!is_compatible(c) || match(c.observation) != none ||
          taken_[static_cast<std::size_t>(c.landmark)] != 0)
        continue;
      if (best == nullptr || c.cost < best->cost) best = &c;
    }
    if (best == nullptr || pairs_.size() == most_pairs) break;
    match_[static_cast<std::size_t>(best->observation)] = best->landmark;
    taken_[static_cast<std::size_t>(best->landmark)] = 1;
    const auto i = static_cast<int>(best - candidates_.data());
    if (std::isfinite(extend(i, static_cast<int>(pairs_.size())))) pairs_.push_back(i);
  }
}

/// order_ has the observations that are known best first: they tell the others where to be.
void ScanMatcher::sort_candidates() {
  first_.assign(match_.size(), none);
  order_.clear();
  for (int i = static_cast<int>(candidates_.size()) - 1; i >= 0; --i) {
    if (!is_compatible(candidate(i))) continue;
    int& first = first_[static_cast<std::size_t>(candidate(i).observation)];
    if (first == none) order_.push_back(candidate(i).observation);
    if (first == none || candidate(i).cost <= candidate(first).cost) first = i;
  }
  const auto area = [&](int observation) {
    return candidate(first_[static_cast<std::size_t>(observation)]).S.determinant();
  };
  std::ranges::sort(order_, [&](int a, int b) { return area(a) != area(b) ? area(a) < area(b) : a < b; });
  if (order_.size() > most_pairs) order_.resize(most_pairs);
}

void ScanMatcher::match_jointly() {
  sort_candidates();
  chosen_.assign(order_.size(), none);
  best_.chosen.assign(order_.size(), none);
  best_.pairs = -1;
  steps_ = 0;
  search(0, 0, 0.0);
  take(best_.chosen);
}

/// Notes the pairs, and leaves L_ and y_ as theirs.
void ScanMatcher::take(std::span<const int> chosen) {
  pairs_.clear();
  for (const int i : chosen) {
    if (i == none) continue;
    extend(i, static_cast<int>(pairs_.size()));
    pairs_.push_back(i);
    match_[static_cast<std::size_t>(candidate(i).observation)] = candidate(i).landmark;
    taken_[static_cast<std::size_t>(candidate(i).landmark)] = 1;
  }
}

bool ScanMatcher::is_worth(int pairs, double squared_distance) const {
  if (best_.pairs < 0) return true;
  if (steps_ >= most_steps_) return false;
  return pairs > best_.pairs || (pairs == best_.pairs && squared_distance < best_.squared_distance);
}

/// Branch and bound. Of an observation all its candidates are tried, the likeliest first, and none of them.
void ScanMatcher::search(std::size_t level, int pairs, double squared_distance) {
  if (level == order_.size()) {
    best_.pairs = pairs;
    best_.squared_distance = squared_distance;
    std::ranges::copy(chosen_, best_.chosen.begin());
    return;
  }
  const auto left = static_cast<int>(order_.size() - level);
  const int observation = order_[level];
  const int likeliest = first_[static_cast<std::size_t>(observation)];
  const auto try_one = [&](int i) {
    const Candidate& c = candidate(i);
    if (taken_[static_cast<std::size_t>(c.landmark)] != 0 || !is_worth(pairs + left, squared_distance))
      return;
    ++steps_;
    const double together = squared_distance + extend(i, pairs);
    if (!(together <= gate(pairs + 1)) || !is_worth(pairs + left, together)) return;
    pairs_.push_back(i);
    taken_[static_cast<std::size_t>(c.landmark)] = 1;
    chosen_[level] = i;
    search(level + 1, pairs + 1, together);
    chosen_[level] = none;
    taken_[static_cast<std::size_t>(c.landmark)] = 0;
    pairs_.pop_back();
  };
  try_one(likeliest);
  for (int i = 0; i < static_cast<int>(candidates_.size()); ++i) {
    if (i != likeliest && candidate(i).observation == observation && is_compatible(candidate(i))) try_one(i);
  }
  if (is_worth(pairs + left - 1, squared_distance)) search(level + 1, pairs, squared_distance);
}

/// Of the innovation of a candidate with those of the first `pairs` pairs, in cross_ (2 pairs x 2),
/// multiplied by L^-1.
void ScanMatcher::cross_covariances(const Candidate& c, int pairs) {
  const Eigen::Index k = 2 * Eigen::Index{pairs};
  for (int j = 0; j < pairs; ++j) {
    const int other = pairs_[static_cast<std::size_t>(j)];
    const auto response = responses_.middleCols<2>(2 * static_cast<Eigen::Index>(other));
    cross_.middleRows<2>(2 * static_cast<Eigen::Index>(j)) =
        (c.expected.J_x * response.topRows<3>() +
         c.expected.J_m * response.middleRows<2>(3 + 2 * static_cast<Eigen::Index>(c.landmark)))
            .transpose();
  }
  auto cross = cross_.topRows(k);
  L_.topLeftCorner(k, k).triangularView<Eigen::Lower>().solveInPlace(cross);
}

/// The innovation of a candidate and its covariance, given the first `pairs` pairs. False if that is not
/// positive definite.
bool ScanMatcher::condition(const Candidate& c, int pairs, Eigen::Vector2d& v, Eigen::Matrix2d& S) {
  cross_covariances(c, pairs);
  const Eigen::Index k = 2 * Eigen::Index{pairs};
  v = c.expected.v;
  v -= cross_.topRows(k).transpose().lazyProduct(y_.head(k));
  S = c.S;
  S -= cross_.topRows(k).transpose().lazyProduct(cross_.topRows(k));
  return S(0, 0) > 0.0 && S.determinant() > 0.0;
}

/// Puts a candidate behind the first `pairs` pairs in L_ and y_. Returns what it adds to the joint v' S^-1 v;
/// infinity, with nothing put there, if the covariance is not positive definite.
double ScanMatcher::extend(int i, int pairs) {
  Eigen::Vector2d v;
  Eigen::Matrix2d S;
  if (!condition(candidate(i), pairs, v, S)) return std::numeric_limits<double>::infinity();
  const Eigen::Index k = 2 * Eigen::Index{pairs};
  const Eigen::LLT<Eigen::Matrix2d> llt(S);
  L_.block(k, 0, 2, k) = cross_.topRows(k).transpose();
  L_.block<2, 2>(k, k) = llt.matrixL();
  llt.matrixL().solveInPlace(v);
  y_.segment<2>(k) = v;
  return v.squaredNorm();
}

bool ScanMatcher::may_be_known(int observation) {
  for (const Candidate& c : candidates_) {
    if (c.observation != observation) continue;
    Eigen::Vector2d v;
    Eigen::Matrix2d S;
    if (!condition(c, static_cast<int>(pairs_.size()), v, S) || v.dot(S.inverse() * v) <= far_) return true;
  }
  return false;
}

}  // namespace seif
