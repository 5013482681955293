// The picture of an estimator's belief. Only what is in view is read from the estimator.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "harness/figures/palette.hpp"
#include "harness/film/camera_man.hpp"
#include "harness/film/matrix_picture.hpp"
#include "harness/film/point_index.hpp"
#include "harness/film/series.hpp"
#include "harness/film/stage.hpp"
#include "harness/film/trail.hpp"
#include "harness/run/live_loop.hpp"
#include "harness/score/true_names.hpp"
#include "harness/statistics/losses.hpp"
#include "harness/stream/run_listener.hpp"
#include "sim/render/scene.hpp"

namespace harness {

/// What a frame must know about the camera.
struct Gaze {
  Frustum frustum;
  Area area;             // [m] the ground in view
  float scale;           // [-] factor for lengths in pixels
  float mark_scale;      // [-] the same for marks that come by the thousands: smaller if the camera is far
                         // away
  double robot_size;     // [-] the robot is drawn this much larger than it is, so that it can be seen
  double smallest_mark;  // [m] anything shorter is hidden behind the dot of a landmark
};

class BeliefView {
 public:
  /// Charts run from `start` to `end` [s] in `bins` intervals. `estimator` must outlive the view.
  BeliefView(const LiveEstimator& estimator, Rgb colour, double start, double end, int bins);

  void scan(const ScanEvent& event);
  void update(const UpdateRecord& record);

  /// Reads what a frame shows. `T_since` is the odometry since the last event; the estimate moves by it, as
  /// smoothly as the robot.
  void look(const Gaze& gaze, const seif::Pose2& T_since, const worlds::FilmLayers& layers);

  /// Takes in new landmarks. Reads what is not read for each frame if it is due: the matrix, and covariances
  /// that must be computed. look() calls it; a call between frames keeps the charts up to date.
  void refresh(const worlds::FilmLayers& layers);

  /// Appends what look() has read.
  void append(const Gaze& gaze, const worlds::FilmLayers& layers, const Stage& stage,
              const std::optional<seif::Pose2>& true_pose, render::Things& things) const;

  const std::string& name() const { return estimator_.name; }
  const std::string& failure() const { return estimator_.failure; }
  Rgb colour() const { return colour_; }
  std::size_t landmarks() const { return means_.size(); }
  std::int64_t links() const { return links_; }
  bool is_lost() const { return losses_.is_lost(); }
  /// Whether the filter has found its place again in the last seconds.
  bool was_found() const;
  const Series& update_times() const { return update_times_; }        // [us]
  const Series& position_errors() const { return position_errors_; }  // [m]
  const Series& three_sigma() const { return three_sigma_; }          // [m]
  const MatrixPicture& matrix() const { return matrix_; }
  seif::BeliefMatrix kind() const { return estimator_.filter->belief_matrix(); }  // of the matrix

 private:
  void read_means(const Gaze& gaze);
  void read(const std::vector<seif::LandmarkId>& landmarks);
  void read_couplings(const worlds::FilmLayers& layers);
  void read_covariances(const worlds::FilmLayers& layers);
  void read_all_covariances();
  void note_active();
  void note_loss(const seif::Counts& counts);
  double freshness(seif::LandmarkId from, seif::LandmarkId to) const;
  void note_sigma(const Eigen::Matrix3d& covariance);
  void append_map(const Gaze& gaze, const worlds::FilmLayers& layers, const Stage& stage,
                  render::Things& things) const;
  void append_uncertainty(seif::LandmarkId id, const Eigen::Vector2d& mean, const Gaze& gaze,
                          const worlds::FilmLayers& layers, const Stage& stage, render::Marks& marks) const;
  void append_links(const Gaze& gaze, const worlds::FilmLayers& layers, render::Things& things) const;
  void append_robot(const Gaze& gaze, const worlds::FilmLayers& layers,
                    const std::optional<seif::Pose2>& true_pose, render::Things& things) const;

  /// When something that is not read for each frame was last read.
  struct Refresh {
    std::size_t scans = 0;  // [-] since the last one
    bool was_done = false;
    /// True if more than `period` scans have passed, or if this is the first time. The count then starts
    /// again.
    bool is_due(std::size_t period);
  };

  struct DrawnLink {
    seif::LandmarkId from;
    seif::LandmarkId to;
    double weight;  // [-] strength times freshness
  };

  const LiveEstimator& estimator_;
  Rgb colour_;
  Trail trail_;
  Series update_times_;
  Series position_errors_;
  Series three_sigma_;
  MatrixPicture matrix_;

  ScanEvent scan_;                     // the latest, for a filter that names landmarks by itself
  TrueNames true_names_;               // of its names
  PointIndex means_{4.0};              // all landmarks, each with the mean that was read last
  std::vector<seif::LandmarkId> new_;  // seen since the last frame, perhaps in the map by now
  std::size_t turn_ = 0;               // number of the landmark out of view that is read next
  std::int64_t links_ = 0;
  double t_ = 0.0;  // [s] of the last update
  Losses losses_;
  std::int64_t left_out_ = 0, relocations_ = 0;  // [-] up to the last update
  Refresh matrix_refresh_;
  Refresh covariance_refresh_;
  std::optional<Eigen::Matrix3d> pose_covariance_;                     // empty if not known
  std::unordered_map<seif::LandmarkId, Eigen::Matrix2d> covariances_;  // each as read last

  double ageing_;                                             // [s] time constant with which links fade
  std::unordered_map<seif::LandmarkId, double> last_active_;  // [s] when each had a link to the robot last

  // For the present frame; reused.
  seif::Pose2 pose_;
  std::vector<seif::LandmarkId> in_view_;
  std::vector<seif::LandmarkEstimate> read_;
  std::vector<seif::Coupling> couplings_;
  std::vector<seif::LandmarkId> active_;  // ascending
  std::vector<DrawnLink> drawn_links_;
  double weakest_drawn_ = 0.0;  // [-] links of at least this weight are drawn; 0: all
};

}  // namespace harness
