// The settings of a film of a run.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace worlds {

enum class FilmCamera {
  overview,  // the whole ground, from above
  chase,     // behind the robot
  orbit,     // round the robot
  top,       // straight down on the robot, north at the top
  fixed,     // from eye to target
};

/// The layers that a film of a run shows.
struct FilmLayers {
  bool grid = true;        // lines on the ground
  bool shadows = true;     //
  bool rays = true;        // lines of sight of the latest scan, free and occluded
  bool range = true;       // the area that the sensor covers
  bool truth = true;       // trail of the true robot
  bool odometry = true;    // trail of dead reckoning
  bool estimate = true;    // trail and present pose of each estimator
  bool landmarks = true;   // estimates of landmarks
  bool ellipses = true;    // 2-sigma ellipses of landmarks and robot
  bool errors = true;      // lines from each estimate to the truth
  bool active = true;      // landmarks that have a link to the robot
  bool links = true;       // links between landmarks
  bool matrix = true;      // normalised information matrix, or covariance
  bool times = true;       // chart of update times
  bool pose_error = true;  // chart of pose errors with their 3-sigma bands
  bool caption = true;     //
  bool legend = true;      //
};

struct Film {
  int width = 1280;    // [px] even
  int height = 720;    // [px] even
  int fps = 30;        // [1/s] of film time
  double speed = 0.0;  // [-] simulated time / film time; 0: chosen so that the film takes 40 s at most
  FilmCamera camera = FilmCamera::overview;
  Eigen::Vector3d eye = {-15, -15, 12};  // [m] of the fixed camera
  Eigen::Vector3d target = {0, 0, 0};    // [m] of the fixed camera
  std::vector<std::string> estimators;  // one or two names; empty: seif and ekf if they run, or the first two
  FilmLayers layers;
};

}  // namespace worlds
