#include "seif/association/associating_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ranges>

#include "seif/measurement_steps.hpp"

namespace seif {
namespace {

constexpr double cells_in_reach = 4.0;            // [-] how finely the grid divides what the robot sees
constexpr std::size_t most_asked = 64;            // [-] landmarks near the observations of a scan; at least
constexpr std::size_t few_per_observation = 3;    // [-] for each of them
constexpr std::size_t most_per_observation = 12;  // [-]
constexpr std::size_t most_wanted = 8;            // [-] landmarks that a scan may ask to have at hand
constexpr int patience = 30;                      // [-] scans that something new waits for these
constexpr int fewest_expected = 40;               // [-] scans before a landmark may be taken out
constexpr std::size_t most_suspicions = 32;       // [-] at a time
constexpr int scans_to_merge = 5;                 // [-] that saw one of two
constexpr int never = -1'000'000;                 // [-] of these, for two that were seen at once
constexpr int fewest_compared = 2;   // [-] observations or landmarks, for a scan to say that it does not fit
constexpr double some_doubt = 4.6;   // [nat] log 100
constexpr double most_doubt = 27.6;  // [nat] log 1e12, since what hides one landmark hides others, too
constexpr int scans_to_fit_again = 5;  // [-] after which only the search tells where the robot is
constexpr int lately = 15;             // [-] scans

double largest_variance(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * covariance.trace();
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return mean + std::hypot(half_difference, covariance(0, 1));
}

}  // namespace

AssociatingFilter::AssociatingFilter(std::unique_ptr<Estimator> filter, const EstimatorSetup& setup,
                                     const AssociationOptions& options, LocalMap::MakeFilter make_local)
    : FilterAround(std::move(filter)),
      belief_(belief_for("association")),
      T_robot_sensor_(setup.T_robot_sensor),
      options_(options),
      matcher_(options.match_probability, options.new_probability),
      merge_gate_(chi_square_gate(1, options.merge_probability)),
      tentative_(options.forget_after),
      make_local_(std::move(make_local)) {
  // More than scans mostly need, so that none comes to ask for more when the map is long known.
  suspicions_.reserve(most_suspicions);
  for (auto* ids : {&at_hand_, &asked_, &wanted_}) ids->reserve(4 * most_asked);
  near_.reserve(4 * most_asked);
  pairs_.reserve(16 * most_asked);
  const auto room = static_cast<Eigen::Index>(3 + 2 * most_asked);
  Sigma_.resize(room, room);
}

void AssociatingFilter::motion_update(const Odometry& odometry) {
  const Eigen::Matrix3d& R = odometry.covariance;
  wander_ += R(0, 0) + R(1, 1) + records_.view().reach() * records_.view().reach() * R(2, 2);
  filter_->motion_update(odometry);
  if (finder_ && finder_->lost.is_on()) finder_->lost.motion_update(odometry);
}

void AssociatingFilter::measurement_update(const Scan& scan, const StageDone& done) {
  ++scan_;
  widen_view(scan);
  belief_.begin_association(scan.t);
  tentative_.begin_scan(std::exchange(wander_, 0.0));
  refresh_grid();
  find_pairs(scan);
  if (finder_ && is_lost(scan)) {
    look_for_place(scan);
  } else {
    last_home_ = scan_;
    name(scan);
    note_expected();
    suspect();
    merge();
    belief_.want(wanted_);
    if (finder_) look_for_closing(scan.t);
  }
  filter_->measurement_update(named_, done);
}

/// The first scan that sees something says how large the cells of the grid are.
void AssociatingFilter::widen_view(const Scan& scan) {
  records_.view().widen(scan.observations);
  constexpr double least_cell = 1e-3;  // [m]
  if (!grid_ && !scan.observations.empty()) {
    grid_.emplace(std::max(least_cell, records_.view().reach() / cells_in_reach));
    if (make_local_)
      finder_.emplace(belief_, *grid_, make_local_, T_robot_sensor_, options_.wrong_place_probability);
  }
  if (!finder_) return;
  for (const Observation& observation : scan.observations)
    finder_->map.widen(observation.range, sd_of_sighting(observation));
}

/// Landmarks at hand may have moved; all others wait until they are.
void AssociatingFilter::refresh_grid() {
  belief_.landmarks_at_hand(at_hand_);
  std::erase_if(at_hand_, [&](LandmarkId id) { return records_[id].is_retired; });
  for (const LandmarkId id : at_hand_) grid_->move(id, belief_.mean_of(id));
}

// A robot that is lost.

/// [nat] How improbable this scan is if the robot is where the filter believes, given how reliably its landmarks have
/// been seen: those that should be seen and are not. Zero if most of what is seen is known, or nothing is.
double AssociatingFilter::doubt_of(const Scan& scan) const {
  const auto observed = static_cast<int>(scan.observations.size());
  const int paired = pairs_found(observed);
  if (observed < fewest_compared || 2 * paired >= observed) return 0.0;
  int missed = 0;
  double doubt = 0.0;
  for (const LandmarkId id : at_hand_) {
    const bool is_due = records_[id].last_seen == last_home_ ? records_.is_in_view(p_sensor(id))
                                                             : records_.should_be_seen(id, p_sensor(id));
    if (!is_due || is_paired(id, observed)) continue;
    ++missed;
    doubt -= std::log(1.0 - records_.reliability(id));
  }
  const int comparable = std::min(observed, paired + missed);
  return comparable >= fewest_compared && 2 * paired < comparable ? doubt : 0.0;
}

int AssociatingFilter::pairs_found(int observed) const {
  return static_cast<int>(std::ranges::count_if(
      std::views::iota(0, observed), [&](int i) { return matcher_.match(i) != ScanMatcher::none; }));
}

bool AssociatingFilter::is_paired(LandmarkId id, int observed) const {
  return std::ranges::any_of(std::views::iota(0, observed), [&](int i) {
    const int match = matcher_.match(i);
    return match != ScanMatcher::none && asked_[static_cast<std::size_t>(match)] == id;
  });
}

/// What the filter expects is broken off by scans in a row that do not fit: they are held back, and begin a search as
/// soon as chance is out of the question.
bool AssociatingFilter::is_lost(const Scan& scan) {
  UnnamedSearch& search = finder_->lost;
  if (!search.is_on()) {
    const double doubt = doubt_of(scan);
    if (doubt < some_doubt) {
      doubt_ = 0.0;
      return false;
    }
    const bool is_first = doubt_ == 0.0;
    doubt_ += doubt;
    if (is_first || doubt_ < most_doubt) return true;
    finder_->map.settle_all();
    if (finder_->map.is_empty()) return false;
    fitting_ = 0;
    searched_ = 0;
    search.begin();
    return true;
  }
  // An outlier of a whole scan: what comes soon afterwards fits again.
  ++searched_;
  const auto observed = static_cast<int>(scan.observations.size());
  const int paired = pairs_found(observed);
  fitting_ = paired >= fewest_compared && 2 * paired > observed ? fitting_ + 1 : 0;
  if (searched_ > scans_to_fit_again || fitting_ < 2) return true;
  search.end();
  doubt_ = 0.0;
  return false;
}

/// The filter gets no observation of this scan. If the robot is found, it is told so.
void AssociatingFilter::look_for_place(const Scan& scan) {
  held_back_ += std::ssize(scan.observations);
  names_.assign(scan.observations.size(), no_landmark);
  named_.t = scan.t;
  named_.observations.clear();
  if (!finder_->lost.is_on()) return;
  std::optional<Relocation> found = finder_->lost.measurement_update(scan, filter_->pose());
  if (!found) return;
  for (std::size_t i = 0; i < found->surroundings.size(); ++i) {
    LandmarkId& name = found->surroundings.landmarks[i];
    if (name == no_landmark) name = new_name(found->T_world_robot * found->surroundings.at(i));
    records_.note_seen(name, scan_, found->surroundings.at(i).norm());
  }
  belief_.relocate(*found);
  finder_->lost.end();
  doubt_ = 0.0;
  last_home_ = scan_;
}

/// Whether landmarks that have joined lately are in the map already.
void AssociatingFilter::look_for_closing(double t) {
  finder_->map.keep_up(scan_);
  if (!options_.seeks_closings || finder_->map.just_settled().empty()) return;
  LandmarkId oldest = std::numeric_limits<LandmarkId>::max();
  for (const LandmarkId id : at_hand_) {
    if (records_[id].last_seen > scan_ - lately) oldest = std::min(oldest, id);
  }
  if (const std::optional<Closing> closing = finder_->closing.look(filter_->pose(), oldest, t))
    close(*closing);
}

/// What the filter contradicts is put back instead, and what lies around the robot at the wrong place is forgotten.
void AssociatingFilter::close(const Closing& closing) {
  if (!closing.relocation) {
    for (const auto& [young, old] : closing.twins) join(old, young);
    return;
  }
  belief_.relocate(*closing.relocation);
  for (const auto& [young, old] : closing.twins) {
    records_[old].last_seen = records_[young].last_seen;
    rename(young, old);
  }
  for (const LandmarkId id : closing.around) {
    retire(id);
    rename(id, no_landmark);
  }
  std::erase_if(named_.observations, [](const Observation& z) { return z.landmark == no_landmark; });
}

LandmarkId AssociatingFilter::new_name(const Eigen::Vector2d& p_world) {
  const LandmarkId id = records_.add();
  grid_->add(p_world);
  if (finder_) finder_->map.note_joined(id, scan_);
  return id;
}

/// From the pose that the filter believes.
Eigen::Vector2d AssociatingFilter::p_sensor(LandmarkId id) const {
  return inverse(filter_->pose() * T_robot_sensor_) * belief_.mean_of(id);
}

// Candidates.

/// Mostly all that is seen is known, and a few landmarks near each observation explain it. Otherwise as many
/// as may have to be thought of.
void AssociatingFilter::find_pairs(const Scan& scan) {
  Eigen::Matrix3d P_x;
  belief_.covariance_with({}, P_x);
  const std::size_t each = std::clamp(most_asked / std::max<std::size_t>(scan.observations.size(), 1),
                                      few_per_observation, most_per_observation);
  for (const std::size_t max_count : {few_per_observation, each}) {
    find_candidates(scan, P_x, max_count);
    options_.jointly ? matcher_.match_jointly() : matcher_.match_nearest();
    if (matcher_.all_matched() || each == few_per_observation) return;
  }
}

void AssociatingFilter::find_candidates(const Scan& scan, const Eigen::Matrix3d& P_x, std::size_t max_count) {
  asked_.clear();
  wanted_.clear();
  pairs_.clear();
  seen_.clear();
  for (const Observation& observation : scan.observations) gather_near(observation, P_x, max_count);
  const auto n = static_cast<Eigen::Index>(3 + 2 * asked_.size());
  if (Sigma_.rows() < n) Sigma_.resize(2 * n, 2 * n);
  belief_.covariance_with(asked_, Sigma_.topLeftCorner(n, n));
  blocks_touched_ += static_cast<std::int64_t>((asked_.size() + 1) * (asked_.size() + 2) / 2);
  matcher_.begin(static_cast<int>(seen_.size()), Sigma_.topLeftCorner(n, n));
  for (const Pair& pair : pairs_) {
    const Observation& observation = scan.observations[static_cast<std::size_t>(pair.observation)];
    matcher_.add(pair.observation, pair.landmark,
                 belief_.expect(asked_[static_cast<std::size_t>(pair.landmark)], observation),
                 observation.covariance);
  }
}

/// The landmarks about where the observation says that something is, as far away as pose, landmark and sensor
/// may err.
void AssociatingFilter::gather_near(const Observation& observation, const Eigen::Matrix3d& P_x,
                                    std::size_t max_count) {
  const InverseObservation inverse = invert_observation(filter_->pose(), T_robot_sensor_, observation);
  const Eigen::Matrix2d by_sensor =
      inverse.J_wrt_observation * observation.covariance * inverse.J_wrt_observation.transpose();
  const Eigen::Matrix2d in_world = inverse.J_wrt_pose * P_x * inverse.J_wrt_pose.transpose() + by_sensor;
  const double variance = std::max(largest_variance(in_world), largest_variance(by_sensor));
  seen_.push_back(
      {inverse.p_world_landmark, largest_variance(by_sensor), std::sqrt(variance * matcher_.gate())});
  // The landmark is taken to be known no worse than this.
  const double radius = std::sqrt(2.0 * variance * matcher_.widest_gate());
  grid_->find_near(inverse.p_world_landmark, radius, max_count, near_);
  for (const LandmarkGrid::Near& near : near_) {
    if (belief_.is_at_hand(near.landmark))
      pairs_.push_back({static_cast<int>(seen_.size()) - 1, number_of(near.landmark)});
  }
}

/// Among asked_, to which it is added if need be.
int AssociatingFilter::number_of(LandmarkId id) {
  const auto found = std::ranges::find(asked_, id);
  const auto number = static_cast<int>(found - asked_.begin());
  if (found == asked_.end()) asked_.push_back(id);
  return number;
}

// Names.

void AssociatingFilter::name(const Scan& scan) {
  names_.assign(scan.observations.size(), no_landmark);
  named_.t = scan.t;
  named_.observations.clear();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const int match = matcher_.match(static_cast<int>(i));
    names_[i] = match == ScanMatcher::none ? name_if_new(i) : asked_[static_cast<std::size_t>(match)];
    if (names_[i] == no_landmark) continue;
    records_.note_seen(names_[i], scan_, scan.observations[i].range);
    named_.observations.push_back(scan.observations[i]);
    named_.observations.back().landmark = names_[i];
  }
}

/// The name of a landmark that has just joined the map, if it is time.
LandmarkId AssociatingFilter::name_if_new(std::size_t observation) {
  if (matcher_.may_be_known(static_cast<int>(observation))) return no_landmark;
  const Seen& seen = seen_[observation];
  const TentativeLandmarks::Sighting sighting = tentative_.see(seen.p_world, seen.variance, matcher_.gate());
  if (sighting.times < options_.admit_after) return no_landmark;
  if (want_near(seen) && sighting.age < patience) return no_landmark;
  tentative_.admit_last();
  return new_name(seen.p_world);
}

/// What may be of it and is not at hand; whether there is such.
bool AssociatingFilter::want_near(const Seen& seen) {
  grid_->find_near(seen.p_world, seen.radius_by_pose, most_per_observation, near_);
  std::erase_if(near_, [&](const LandmarkGrid::Near& near) {
    return is_seen_now(near.landmark) || belief_.is_at_hand(near.landmark);
  });
  for (const LandmarkGrid::Near& near : near_) {
    if (wanted_.size() < most_wanted) wanted_.push_back(near.landmark);
  }
  return !near_.empty();
}

// Those that should have been seen.

void AssociatingFilter::note_expected() {
  for (const LandmarkId id : at_hand_) {
    if (is_seen_now(id) || !records_.should_be_seen(id, p_sensor(id))) continue;
    const int expected = ++records_[id].expected;
    if (expected > fewest_expected && records_[id].seen < options_.remove_below * expected) retire(id);
  }
}

void AssociatingFilter::retire(LandmarkId id) {
  records_[id].is_retired = true;
  grid_->remove(id);
  std::erase_if(suspicions_, [&](const Suspicion& s) { return s.a == id || s.b == id; });
}

// Those that are one.

/// Of each observation that might also be of a second landmark, and of one alone, which this scan does not
/// see.
void AssociatingFilter::suspect() {
  for (Suspicion& s : suspicions_) {
    if (is_seen_now(s.a) && is_seen_now(s.b)) s.scans = never;
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const int match = matcher_.match(static_cast<int>(i));
    if (match == ScanMatcher::none) continue;
    int other = ScanMatcher::none;
    bool is_alone = true;
    for (const Candidate& c : matcher_.candidates()) {
      const LandmarkId id = asked_[static_cast<std::size_t>(c.landmark)];
      if (c.observation != static_cast<int>(i) || c.landmark == match || is_seen_now(id)) continue;
      if (!may_be_one(match, c.landmark)) continue;
      is_alone = is_alone && other == ScanMatcher::none;
      other = c.landmark;
    }
    if (other != ScanMatcher::none && is_alone) suspect(names_[i], asked_[static_cast<std::size_t>(other)]);
  }
}

/// Whether they lie so near to each other, by the covariance of their distance. Numbers of the joint
/// covariance.
bool AssociatingFilter::may_be_one(int a, int b) const {
  const Eigen::Vector2d apart = belief_.mean_of(asked_[static_cast<std::size_t>(a)]) -
                                belief_.mean_of(asked_[static_cast<std::size_t>(b)]);
  return squared_distance_apart(Sigma_, 3 + 2 * a, 3 + 2 * b, apart) <= merge_gate_;
}

void AssociatingFilter::suspect(LandmarkId seen, LandmarkId other) {
  const LandmarkId a = std::min(seen, other);
  const LandmarkId b = std::max(seen, other);
  auto found = std::ranges::find_if(suspicions_, [&](const Suspicion& s) { return s.a == a && s.b == b; });
  if (found == suspicions_.end()) {
    if (suspicions_.size() == most_suspicions)
      suspicions_.erase(std::ranges::min_element(suspicions_, {}, &Suspicion::last_scan));
    suspicions_.push_back({a, b, 0, scan_});
    found = suspicions_.end() - 1;
  }
  ++found->scans;
  found->last_scan = scan_;
}

/// The one that was seen less goes, with its name.
void AssociatingFilter::merge() {
  while (true) {
    const auto sure =
        std::ranges::find_if(suspicions_, [](const Suspicion& s) { return s.scans >= scans_to_merge; });
    if (sure == suspicions_.end()) return;
    const auto [a, b, scans, last_scan] = *sure;
    const LandmarkId goes = records_[b].seen <= records_[a].seen ? b : a;
    const LandmarkId stays = goes == b ? a : b;
    join(stays, goes);
  }
}

void AssociatingFilter::join(LandmarkId stays, LandmarkId goes) {
  belief_.equate(stays, goes);
  records_[stays].seen += records_[goes].seen;
  records_[stays].last_seen = std::max(records_[stays].last_seen, records_[goes].last_seen);
  retire(goes);
  rename(goes, stays);
}

/// In the latest scan.
void AssociatingFilter::rename(LandmarkId from, LandmarkId to) {
  std::ranges::replace(names_, from, to);
  for (Observation& observation : named_.observations) {
    if (observation.landmark == from) observation.landmark = to;
  }
}

// What the harness asks.

Counts AssociatingFilter::counts() const {
  Counts counts = filter_->counts();
  counts.blocks_touched += blocks_touched_ + (finder_ ? finder_->work() : 0);
  counts.gated += held_back_;
  return counts;
}

std::size_t AssociatingFilter::memory_bytes() const {
  return filter_->memory_bytes() + records_.memory_bytes() + tentative_.memory_bytes() +
         (grid_ ? grid_->memory_bytes() : 0) + (finder_ ? finder_->memory_bytes() : 0) +
         sizeof(double) * static_cast<std::size_t>(Sigma_.size());
}

void AssociatingFilter::landmarks(std::span<const LandmarkId> landmarks,
                                  std::vector<LandmarkEstimate>& out) const {
  looked_up_.assign(landmarks.begin(), landmarks.end());
  std::erase_if(looked_up_, [&](LandmarkId id) { return !records_.is_in_map(id); });
  filter_->landmarks(looked_up_, out);
}

void AssociatingFilter::couplings(LandmarkId of, std::vector<Coupling>& out) const {
  out.clear();
  if (of != no_landmark && !records_.is_in_map(of)) return;
  filter_->couplings(of, out);
  std::erase_if(out,
                [&](const Coupling& c) { return c.other != no_landmark && !records_.is_in_map(c.other); });
}

std::vector<LandmarkEstimate> AssociatingFilter::map() const {
  std::vector<LandmarkEstimate> map = filter_->map();
  std::erase_if(map,
                [&](const LandmarkEstimate& estimate) { return !records_.is_in_map(estimate.landmark); });
  return map;
}

/// Without those that are not in the map: marginalised out.
Eigen::MatrixXd AssociatingFilter::whole_belief_matrix() const {
  Eigen::MatrixXd M = filter_->whole_belief_matrix();
  std::vector<int> kept = {0, 1, 2};
  std::vector<int> gone;
  int row = 3;
  for (const LandmarkEstimate& estimate : filter_->map()) {
    std::vector<int>& to = records_.is_in_map(estimate.landmark) ? kept : gone;
    to.insert(to.end(), {row, row + 1});
    row += 2;
  }
  if (gone.empty()) return M;
  if (belief_matrix() == BeliefMatrix::covariance) return M(kept, kept);
  const Eigen::LLT<Eigen::MatrixXd> llt(Eigen::MatrixXd(M(gone, gone)));
  return M(kept, kept) - M(kept, gone) * llt.solve(Eigen::MatrixXd(M(gone, kept)));
}

}  // namespace seif
