#include "harness/live/belief_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <utility>

namespace harness {

namespace {

using std::chrono::milliseconds;

// What one reading may cost.
constexpr std::size_t most_seen = 512;           // [-] landmarks of the latest scans
constexpr std::size_t many_others = 512;         // [-] other landmarks, while the run waits ...
constexpr std::size_t few_others = 96;           // [-] ... and while it does not
constexpr std::size_t most_link_rows = 600;      // [-] landmarks whose links are read
constexpr std::size_t most_drawn_links = 2000;   // [-] the strongest
constexpr std::size_t most_ellipses_read = 500;  // [-] of those in view
constexpr std::size_t most_factorised = 3000;    // [-] a larger map is not factorised while it runs
constexpr std::size_t most_pictured = 10'000;    // [-] landmarks of a matrix that is drawn
constexpr double share_for_links = 0.002;        // [-] of the time of a busy run
constexpr double share_for_ellipses = 0.003;     // [-]
constexpr double share_for_matrix = 0.003;       // [-]
constexpr double idle_share = 0.1;               // [-] for each of them, while the run waits
constexpr float told_again_above = 1e-4F;        // [m] a smaller change of a mean is not told

bool differs(const LivePoint& a, const LivePoint& b) {
  return std::abs(a.x - b.x) > told_again_above || std::abs(a.y - b.y) > told_again_above;
}

}  // namespace

BeliefReader::BeliefReader(const LiveEstimator& estimator)
    : estimator_(estimator),
      links_thrift_(share_for_links, idle_share, milliseconds(200)),
      ellipses_thrift_(share_for_ellipses, idle_share, milliseconds(200)),
      matrix_thrift_(share_for_matrix, idle_share, milliseconds(400)) {}

void BeliefReader::note(seif::LandmarkId landmark) {
  if (noted_.size() < most_seen) noted_.push_back(landmark);
  if (numbers_.try_emplace(landmark, known_.size()).second) known_.push_back({landmark, {}, false});
}

void BeliefReader::scan(const ScanEvent& event) {
  if (!estimator_.filter->needs_names()) return;
  for (const seif::Observation& z : event.scan.observations) note(z.landmark);
}

void BeliefReader::update(const UpdateRecord& record) {
  if (record.associations) {
    for (const seif::LandmarkId landmark : *record.associations) {
      if (landmark != seif::no_landmark) note(landmark);
    }
  }
  figures_.update(record);
  trail_.add(record.est_pose.x, record.est_pose.y);
  is_stale_ = has_stale_ellipses_ = true;
}

BeliefReader::Clock::duration BeliefReader::read(const LiveView& view, Depth depth, LiveBelief& out) {
  apart_ = {};
  is_idle_ = depth == Depth::much;
  try {
    read_all(view, depth, out);
  } catch (const std::exception&) {  // an improper belief cannot be read; the run itself reports it
  }
  return apart_;
}

void BeliefReader::read_all(const LiveView& view, Depth depth, LiveBelief& out) {
  out.failure = estimator_.failure;
  out.means.clear();
  out.ellipses.clear();
  out.links.reset();
  figures_.hand_over(out.charts);
  trail_.hand_over(out.trail);
  figures_.read_quantiles();
  out.figures = figures_.figures();
  out.figures.landmarks = static_cast<std::int64_t>(means_.size());
  if (!estimator_.failure.empty()) return;
  out.pose = estimator_.filter->pose();
  read_active(out);
  if (depth == Depth::pose) return;
  if (const auto covariance = estimator_.filter->pose_covariance()) out.covariance = covariance;
  if (view.area.min != area_.min || view.area.max != area_.max) is_stale_ = has_stale_ellipses_ = true;
  area_ = view.area;
  read_means(depth == Depth::much ? many_others : few_others, out);
  read_links(view, out);
  read_ellipses(view, out);
}

/// Counts what was spent by a thrift of its own.
void BeliefReader::count(Thrift& thrift, Clock::time_point begin) {
  const Clock::duration cost = Clock::now() - begin;
  thrift.spent(begin, cost);
  apart_ += cost;
}

void BeliefReader::read_active(LiveBelief& out) {
  out.active.clear();
  if (estimator_.filter->belief_matrix() != seif::BeliefMatrix::information) return;
  estimator_.filter->couplings(seif::no_landmark, couplings_);
  for (const seif::Coupling& coupling : couplings_) out.active.push_back(coupling.other);
}

/// The landmarks of the latest scans, and others in turn: what a closure has moved is found after a while.
void BeliefReader::read_means(std::size_t others, LiveBelief& out) {
  wanted_.swap(noted_);
  noted_.clear();
  for (std::size_t i = 0; i < std::min(others, known_.size()); ++i)
    wanted_.push_back(known_[turn_++ % known_.size()].landmark);
  std::ranges::sort(wanted_);
  wanted_.erase(std::ranges::unique(wanted_).begin(), wanted_.end());
  estimator_.filter->landmarks(wanted_, estimates_);
  for (const seif::LandmarkEstimate& estimate : estimates_) {
    means_.put(estimate.landmark, estimate.mean);
    Known& known = known_[numbers_.at(estimate.landmark)];
    const LivePoint p{static_cast<float>(estimate.mean.x()), static_cast<float>(estimate.mean.y())};
    if (known.was_told && !differs(known.told, p)) continue;
    known = {estimate.landmark, p, true};
    out.means.push_back({estimate.landmark, p});
  }
}

/// Landmarks in view, evenly chosen if there are more than `most`.
void BeliefReader::find_shown(const LiveView& view, std::size_t most) {
  means_.within(view.area, shown_);
  if (shown_.size() <= most) return;
  const std::size_t stride = (shown_.size() + most - 1) / most;
  for (std::size_t i = 0; i * stride < shown_.size(); ++i) shown_[i] = shown_[i * stride];
  shown_.resize((shown_.size() + stride - 1) / stride);
}

void BeliefReader::read_links(const LiveView& view, LiveBelief& out) {
  const Clock::time_point begin = Clock::now();
  if (!view.links || !is_stale_ || !links_thrift_.may(begin, is_idle_)) return;
  if (estimator_.filter->belief_matrix() != seif::BeliefMatrix::information) return;
  is_stale_ = false;
  find_shown(view, most_link_rows);
  std::vector<LiveLink>& links = out.links.emplace();
  for (const seif::LandmarkId id : shown_) {
    estimator_.filter->couplings(id, couplings_);
    for (const seif::Coupling& coupling : couplings_) {
      if (coupling.other != seif::no_landmark && coupling.other > id)
        links.push_back({id, coupling.other, static_cast<float>(coupling.strength)});
    }
  }
  if (links.size() > most_drawn_links) {
    std::ranges::nth_element(links, links.begin() + most_drawn_links, std::ranges::greater{},
                             &LiveLink::weight);
    links.resize(most_drawn_links);
  }
  count(links_thrift_, begin);
}

/// A filter in covariance form has the covariances at hand. Other filters must factorise their whole matrix.
void BeliefReader::read_ellipses(const LiveView& view, LiveBelief& out) {
  const Clock::time_point begin = Clock::now();
  if (!has_stale_ellipses_ || !ellipses_thrift_.may(begin, is_idle_) || view.pages == 0) return;
  const bool is_at_hand = estimator_.filter->belief_matrix() == seif::BeliefMatrix::covariance;
  if (!is_at_hand && means_.size() > most_factorised) return;
  has_stale_ellipses_ = false;
  find_shown(view, most_ellipses_read);
  const auto belief = estimator_.filter->marginal_covariances(shown_);
  count(ellipses_thrift_, begin);
  if (!belief) return;
  if (!out.covariance && belief->pose.allFinite()) out.covariance = belief->pose;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Eigen::Matrix2d& P = belief->landmarks[i];
    if (P.allFinite())
      out.ellipses.push_back(
          {shown_[i], static_cast<float>(P(0, 0)), static_cast<float>(P(0, 1)), static_cast<float>(P(1, 1))});
  }
}

bool BeliefReader::read_matrix(LiveMatrix& out) {
  const Clock::time_point begin = Clock::now();
  if (!estimator_.failure.empty() || !matrix_thrift_.may(begin, is_idle_) || means_.size() > most_pictured)
    return false;
  try {
    picture_.read(*estimator_.filter, means_);
  } catch (const std::exception&) {
    return false;
  }
  count(matrix_thrift_, begin);
  out.size = picture_.size();
  out.fill = picture_.fill();
  out.darkness.clear();
  for (const float strength : picture_.cells())
    out.darkness.push_back(static_cast<std::uint8_t>(
        std::lround(255.0F * std::clamp(MatrixPicture::darkness(picture_.matrix(), strength), 0.0F, 1.0F))));
  return out.size > 0;
}

}  // namespace harness
