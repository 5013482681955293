#include "harness/film/belief_view.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <utility>

#include "harness/film/paint.hpp"
#include "harness/statistics/ellipse.hpp"

namespace harness {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t others_read = 256;  // [-] landmarks out of view that each frame reads, in turn
// The number of scans between two refreshes grows with the cost of a refresh, so that the mean cost of a scan
// is bounded.
constexpr std::size_t landmarks_for_each_scan = 50;  // [-] reading the matrix takes a pass over the map
constexpr std::size_t squared_landmarks_for_each_scan = 12'500;  // [-] marginals cost nearly its square
constexpr std::size_t most_refreshed = 10'000;  // [-] landmarks; larger maps are not read as a whole
// Approximate limits of what a frame draws.
constexpr std::size_t most_links = 2000;     // [-] the strongest links
constexpr std::size_t most_dots = 4000;      // [-] dots of landmarks, a fixed choice
constexpr std::size_t most_ellipses = 1000;  // [-] ellipses and error lines, a fixed choice

constexpr double found_is_told = 5.0;  // [s]

// How dark links are.
constexpr double share_of_run = 0.08;  // [-] links fade with this share of the run as the time constant ...
constexpr double oldest = 0.35;        // [-] ... down to this part of what they were
constexpr double opacity = 4.0;        // [-] of a fresh link over its strength ...
constexpr double most_opaque = 0.85;   // [-] ... up to this
constexpr double faintest = 0.004;     // [-] links of less weight cannot be seen

Vector3d above_ground(const Vector2d& p) { return {p.x(), p.y(), 0.02}; }

/// True for about this share of the landmarks. The choice is always the same; a larger share adds to a
/// smaller one.
bool is_among(seif::LandmarkId id, double share) {
  const auto scattered = static_cast<std::uint32_t>(id) * 2654435769U;  // Fibonacci hashing
  return static_cast<double>(scattered) < share * 4294967296.0;
}

/// [-] the share that leaves about `most` of `count`
double share_of(std::size_t count, std::size_t most) {
  return std::min(1.0, static_cast<double>(most) / static_cast<double>(std::max<std::size_t>(count, 1)));
}

render::Ellipse two_sigma(const Vector2d& mean, const Matrix2d& covariance, Rgb colour, float scale) {
  render::Ellipse ellipse;
  ellipse.centre = above_ground(mean);
  ellipse.axes = ellipse_axes(covariance, 2.0);
  ellipse.outline_width = 1.4F * scale;
  ellipse.outline = paint(colour, 0.9F);
  ellipse.fill = paint(colour, 0.16F);
  return ellipse;
}

}  // namespace

BeliefView::BeliefView(const LiveEstimator& estimator, Rgb colour, double start, double end, int bins)
    : estimator_(estimator),
      colour_(colour),
      trail_(trail_spacing),
      update_times_(start, end, bins),
      position_errors_(start, end, bins),
      three_sigma_(start, end, bins),
      ageing_(std::max(share_of_run * (end - start), 1e-3)),
      pose_(estimator.filter->pose()) {
  trail_.add({pose_.x, pose_.y});
}

void BeliefView::scan(const ScanEvent& event) {
  if (!estimator_.filter->needs_names()) {
    scan_ = event;
    return;
  }
  for (const seif::Observation& z : event.scan.observations) {
    if (!means_.position(z.landmark)) new_.push_back(z.landmark);
  }
}

void BeliefView::update(const UpdateRecord& record) {
  for (const seif::LandmarkId landmark : estimator_.filter->associations()) {
    if (landmark != seif::no_landmark && !means_.position(landmark)) new_.push_back(landmark);
  }
  true_names_.add(estimator_.filter->associations(), scan_);
  t_ = record.t;
  note_active();
  note_loss(record.counts);
  links_ = record.counts.links;
  pose_ = record.est_pose;
  ++matrix_refresh_.scans;
  ++covariance_refresh_.scans;
  trail_.add({pose_.x, pose_.y});
  update_times_.add(record.t, record.times.update);
  if (record.true_pose)
    position_errors_.add(record.t, std::hypot(pose_.x - record.true_pose->x, pose_.y - record.true_pose->y));
  if (record.est_covariance) note_sigma(*record.est_covariance);
}

void BeliefView::note_loss(const seif::Counts& counts) {
  losses_.add({.t = t_,
               .has_used = counts.innovation_degrees > 0,
               .left_out = counts.gated - std::exchange(left_out_, counts.gated),
               .relocations = counts.relocations - std::exchange(relocations_, counts.relocations)});
}

bool BeliefView::was_found() const { return losses_.found_t() && t_ - *losses_.found_t() < found_is_told; }

/// Reads which landmarks have a link to the robot: only links among these change.
void BeliefView::note_active() {
  if (!failure().empty() || kind() != seif::BeliefMatrix::information) return;
  estimator_.filter->couplings(seif::no_landmark, couplings_);
  for (const seif::Coupling& coupling : couplings_) last_active_[coupling.other] = t_;
}

/// How much a link has faded since both of its landmarks could change it, from 1 down to `oldest`. [-]
double BeliefView::freshness(seif::LandmarkId from, seif::LandmarkId to) const {
  const auto first = last_active_.find(from);
  const auto second = last_active_.find(to);
  if (first == last_active_.end() || second == last_active_.end()) return oldest;
  const double age = t_ - std::min(first->second, second->second);
  return oldest + (1.0 - oldest) * std::exp(-age / ageing_);
}

void BeliefView::note_sigma(const Eigen::Matrix3d& covariance) {
  pose_covariance_ = covariance;
  const Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(covariance.topLeftCorner<2, 2>());
  three_sigma_.add(t_, 3.0 * std::sqrt(std::max(0.0, eigen.eigenvalues()(1))));
}

void BeliefView::look(const Gaze& gaze, const seif::Pose2& T_since, const worlds::FilmLayers& layers) {
  if (!failure().empty()) return;
  pose_ = estimator_.filter->pose() * T_since;
  refresh(layers);
  read_means(gaze);
  read_couplings(layers);
  read_covariances(layers);
}

/// Reads the landmarks in view and, in turn, some that are not: a landmark that the map has moved into view
/// is found after a while.
void BeliefView::read_means(const Gaze& gaze) {
  means_.within(gaze.area, in_view_);
  const std::size_t shown = in_view_.size();
  for (std::size_t i = 0; i < std::min(others_read, means_.size()); ++i)
    in_view_.push_back(means_.id(turn_++ % means_.size()));
  read(in_view_);
  in_view_.resize(shown);
  std::erase_if(in_view_, [&](seif::LandmarkId id) {
    return !gaze.frustum.sees(above_ground(*means_.position(id)), 1.0);
  });
}

void BeliefView::read(const std::vector<seif::LandmarkId>& landmarks) {
  estimator_.filter->landmarks(landmarks, read_);
  for (const seif::LandmarkEstimate& landmark : read_) means_.put(landmark.landmark, landmark.mean);
}

void BeliefView::read_couplings(const worlds::FilmLayers& layers) {
  active_.clear();
  drawn_links_.clear();
  if (estimator_.filter->belief_matrix() != seif::BeliefMatrix::information) return;
  estimator_.filter->couplings(seif::no_landmark, couplings_);
  for (const seif::Coupling& coupling : couplings_) active_.push_back(coupling.other);
  std::ranges::sort(active_);
  if (!layers.links) return;
  for (const seif::LandmarkId id : in_view_) {
    estimator_.filter->couplings(id, couplings_);
    for (const seif::Coupling& coupling : couplings_) {
      // A link between two landmarks in view is drawn once. For a landmark out of view, couplings are not
      // read.
      if (coupling.other == seif::no_landmark || coupling.other <= id || !means_.position(coupling.other))
        continue;
      const double weight = coupling.strength * freshness(id, coupling.other);
      if (weight > faintest) drawn_links_.push_back({id, coupling.other, weight});
    }
  }
  weakest_drawn_ = 0.0;
  if (drawn_links_.size() <= most_links) return;
  std::ranges::nth_element(drawn_links_, drawn_links_.begin() + most_links, std::ranges::greater{},
                           &DrawnLink::weight);
  weakest_drawn_ = drawn_links_[most_links].weight;
  drawn_links_.resize(most_links);
}

void BeliefView::refresh(const worlds::FilmLayers& layers) {
  if (!failure().empty()) return;
  read(new_);
  new_.clear();
  if (means_.size() > most_refreshed) return;
  const std::size_t n = means_.size();
  if (layers.matrix && matrix_refresh_.is_due(n / landmarks_for_each_scan))
    matrix_.read(*estimator_.filter, means_);
  // A filter in covariance form has the covariances at hand. Other filters must factorise their whole matrix.
  const bool is_wanted = layers.ellipses || layers.pose_error;
  if (is_wanted && estimator_.filter->belief_matrix() != seif::BeliefMatrix::covariance &&
      covariance_refresh_.is_due(n * n / squared_landmarks_for_each_scan))
    read_all_covariances();
}

bool BeliefView::Refresh::is_due(std::size_t period) {
  if (scans == 0 || (scans <= period && was_done)) return false;
  was_done = true;
  scans = 0;
  return true;
}

/// Reads the covariances of the landmarks in view from a filter that has them at hand.
void BeliefView::read_covariances(const worlds::FilmLayers& layers) {
  if (!layers.ellipses || estimator_.filter->belief_matrix() != seif::BeliefMatrix::covariance) return;
  const auto belief = estimator_.filter->marginal_covariances(in_view_);
  for (std::size_t i = 0; belief && i < in_view_.size(); ++i)
    covariances_[in_view_[i]] = belief->landmarks[i];
}

void BeliefView::read_all_covariances() {
  std::vector<seif::LandmarkId> ids;
  for (const seif::LandmarkEstimate& landmark : estimator_.filter->map()) ids.push_back(landmark.landmark);
  std::optional<seif::MarginalCovariances> belief;
  try {
    belief = estimator_.filter->marginal_covariances(ids);
  } catch (const std::exception&) {  // an improper belief has none; the run itself reports it
  }
  covariances_.clear();
  pose_covariance_.reset();
  if (!belief) return;
  for (std::size_t i = 0; i < ids.size(); ++i) covariances_.emplace(ids[i], belief->landmarks[i]);
  note_sigma(belief->pose);
}

void BeliefView::append(const Gaze& gaze, const worlds::FilmLayers& layers, const Stage& stage,
                        const std::optional<seif::Pose2>& true_pose, render::Things& things) const {
  if (layers.links) append_links(gaze, layers, things);
  if (layers.landmarks || layers.ellipses) append_map(gaze, layers, stage, things);
  append_robot(gaze, layers, true_pose, things);
}

void BeliefView::append_map(const Gaze& gaze, const worlds::FilmLayers& layers, const Stage& stage,
                            render::Things& things) const {
  render::Marks& marks = things.marks_on_top;
  const double dots = share_of(in_view_.size(), most_dots);
  const double ellipses = share_of(in_view_.size(), most_ellipses);
  for (const seif::LandmarkId id : in_view_) {
    const Vector2d mean = *means_.position(id);
    if (is_among(id, ellipses)) append_uncertainty(id, mean, gaze, layers, stage, marks);
    const bool is_active = std::ranges::binary_search(active_, id);
    if (layers.active && is_active)
      marks.dots.push_back({above_ground(mean), 5.5F * gaze.mark_scale, paint(palette::orange)});
    if (layers.landmarks && (is_active || is_among(id, dots)))
      marks.dots.push_back({above_ground(mean), 2.6F * gaze.mark_scale, paint(colour_)});
  }
}

/// Appends the covariance ellipse and the error.
void BeliefView::append_uncertainty(seif::LandmarkId id, const Vector2d& mean, const Gaze& gaze,
                                    const worlds::FilmLayers& layers, const Stage& stage,
                                    render::Marks& marks) const {
  const auto covariance = covariances_.find(id);
  if (layers.ellipses && covariance != covariances_.end() && covariance->second.allFinite() &&
      2.0 * std::sqrt(covariance->second.trace()) > gaze.smallest_mark)
    marks.ellipses.push_back(two_sigma(mean, covariance->second, colour_, gaze.mark_scale));
  const std::optional<Vector2d> truth = stage.true_position(true_id_of(*estimator_.filter, true_names_, id));
  if (layers.errors && truth && (mean - *truth).norm() > gaze.smallest_mark)
    marks.strokes.push_back(
        {above_ground(mean), above_ground(*truth), 1.6F * gaze.mark_scale, paint(palette::purple, 0.9F)});
}

void BeliefView::append_links(const Gaze& gaze, const worlds::FilmLayers& layers,
                              render::Things& things) const {
  std::vector<render::Stroke>& strokes = things.marks_on_top.strokes;
  for (const DrawnLink& link : drawn_links_) {
    // Links near the limit are faint, so that links do not appear or vanish abruptly.
    const double least = std::max(weakest_drawn_, faintest);
    const double share = std::min(1.0, link.weight / least - 1.0);
    const auto alpha = static_cast<float>(share * std::min(most_opaque, opacity * link.weight));
    strokes.push_back({above_ground(*means_.position(link.from)), above_ground(*means_.position(link.to)),
                       1.1F * gaze.mark_scale, paint(paints::faint_ink, alpha)});
  }
  if (!layers.active) return;
  for (const seif::LandmarkId id : active_) {
    if (const auto mean = means_.position(id))
      strokes.push_back({above_ground({pose_.x, pose_.y}), above_ground(*mean), 1.8F * gaze.mark_scale,
                         paint(palette::orange, 0.8F)});
  }
}

void BeliefView::append_robot(const Gaze& gaze, const worlds::FilmLayers& layers,
                              const std::optional<seif::Pose2>& true_pose, render::Things& things) const {
  render::Marks& marks = things.marks_on_top;
  const Vector2d p(pose_.x, pose_.y);
  if (layers.ellipses && pose_covariance_ && pose_covariance_->allFinite())
    marks.ellipses.push_back(two_sigma(p, pose_covariance_->topLeftCorner<2, 2>(), colour_, gaze.scale));
  if (layers.errors && true_pose)
    marks.strokes.push_back({above_ground(p), above_ground({true_pose->x, true_pose->y}), 1.6F * gaze.scale,
                             paint(palette::purple, 0.9F)});
  if (!layers.estimate) return;
  trail_.for_each_leg(p, [&](const Vector2d& from, const Vector2d& to) {
    marks.strokes.push_back({above_ground(from), above_ground(to), 2.0F * gaze.scale, paint(colour_)});
  });
  // The arrowhead is half a metre long in the world, or larger with the robot. With a fixed size on the image
  // it would turn with the camera.
  const double size = gaze.robot_size;
  for (const double side : {2.6, -2.6}) {
    const Vector2d barb = pose_ * Vector2d(size * (0.35 + 0.5 * std::cos(side)), size * 0.5 * std::sin(side));
    marks.strokes.push_back({above_ground(pose_ * Vector2d(size * 0.35, 0.0)), above_ground(barb),
                             2.6F * gaze.scale, paint(colour_)});
  }
}

}  // namespace harness
