#include "harness/recording/recorder.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "harness/recording/cells.hpp"
#include "harness/recording/step_table.hpp"

namespace harness {

namespace {

void write_landmarks(const std::filesystem::path& path, std::span<const TrueLandmark> landmarks) {
  CsvWriter file(path, "landmark,x,y,radius");
  for (const TrueLandmark& landmark : landmarks) {
    file.value(std::int64_t{landmark.landmark}).value(landmark.position.x()).value(landmark.position.y());
    file.value(landmark.radius).end_row();
  }
  file.close();
}

}  // namespace

void write_pose(CsvWriter& file, double t, const seif::Pose2& T_world_robot) {
  file.value(t).value(T_world_robot.x).value(T_world_robot.y).value(0.0);
  file.value(0.0)
      .value(0.0)
      .value(std::sin(0.5 * T_world_robot.theta))
      .value(std::cos(0.5 * T_world_robot.theta));
  file.end_row();
}

Recorder::Recorder(std::filesystem::path folder, const LogDescription& log,
                   std::span<const std::string> estimators)
    : folder_(std::move(folder)),
      has_wheel_angles_(log.has_wheel_angles),
      odometry_(folder_ / "odometry.csv", "t,dx,dy,dtheta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt"),
      observations_(folder_ / "observations.csv", "t,landmark,range,bearing,cov_rr,cov_rb,cov_bb"),
      dead_reckoning_(folder_ / "odometry.tum", no_header, ' ') {
  write_whole_file(folder_ / "log.yaml", to_yaml(log));
  if (log.landmarks) write_landmarks(folder_ / "landmarks.csv", *log.landmarks);
  if (log.has_true_ids) true_ids_.emplace(folder_ / "observations_true_ids.csv", "t,true_landmark");
  if (log.has_truth) {
    truth_.emplace(folder_ / "truth.csv",
                   has_wheel_angles_ ? "t,x,y,theta,left_wheel,right_wheel" : "t,x,y,theta");
    truth_trajectory_.emplace(folder_ / "truth.tum", no_header, ' ');
    truth(log.true_start);
  }
  for (const std::string& name : estimators) estimators_.push_back(open_estimator(name));
}

Recorder::EstimatorFiles Recorder::open_estimator(const std::string& name) const {
  return {
      name, CsvWriter(folder_ / (name + ".tum"), no_header, ' '),
      CsvWriter(folder_ / (name + "_steps.csv"), step_header()),
      CsvWriter(folder_ / (name + "_times.csv"), "t,update,motion,measurement,sparsification,mean_recovery"),
      CsvWriter(folder_ / (name + "_consistency.csv"),
                "t,nees_pose,nees_landmark,landmarks_scored,landmarks_mapped,memory_bytes")};
}

/// Odometry and a scan at the same time share a row.
void Recorder::truth(const std::optional<TruePose>& truth) {
  if (!truth || !truth_ || (last_truth_t_ && *last_truth_t_ == truth->t)) return;
  last_truth_t_ = truth->t;
  const seif::Pose2& pose = truth->T_world_robot;
  truth_->value(truth->t).value(pose.x).value(pose.y).value(pose.theta);
  if (has_wheel_angles_) truth_->value(truth->left_wheel).value(truth->right_wheel);
  truth_->end_row();
  write_pose(*truth_trajectory_, truth->t, pose);
}

void Recorder::odometry(const OdometryEvent& event) {
  const seif::Pose2& increment = event.odometry.T_previous_current;
  odometry_.value(event.odometry.t).value(increment.x).value(increment.y).value(increment.theta);
  write_covariance(odometry_, event.odometry.covariance);
  odometry_.end_row();
  truth(event.truth);
}

void Recorder::scan(const ScanEvent& event) {
  const std::vector<seif::Observation>& observations = event.scan.observations;
  if (observations.empty()) {
    observations_.value(event.scan.t).leave_empty(6).end_row();
    if (true_ids_) true_ids_->value(event.scan.t).leave_empty().end_row();
  }
  for (std::size_t i = 0; i < observations.size(); ++i) {
    observation(event.scan.t, observations[i]);
    if (!true_ids_) continue;
    true_ids_->value(event.scan.t);
    const seif::LandmarkId true_id = event.true_ids.at(i);
    true_id == seif::no_landmark ? true_ids_->leave_empty() : true_ids_->value(std::int64_t{true_id});
    true_ids_->end_row();
  }
  truth(event.truth);
}

void Recorder::observation(double t, const seif::Observation& observation) {
  observations_.value(t);
  observation.landmark == seif::no_landmark ? observations_.leave_empty()
                                            : observations_.value(std::int64_t{observation.landmark});
  observations_.value(observation.range).value(observation.bearing);
  write_covariance(observations_, observation.covariance);
  observations_.end_row();
}

void Recorder::dead_reckoning(double t, const seif::Pose2& T_world_robot) {
  write_pose(dead_reckoning_, t, T_world_robot);
}

void Recorder::update(std::size_t estimator, const UpdateRecord& record) {
  EstimatorFiles& files = estimators_.at(estimator);
  write_pose(files.trajectory, record.t, record.est_pose);

  write_step(files.steps, record);
  files.times.value(record.t).value(record.times.update);
  for (const std::optional<double>& stage : record.times.stages) write_if_known(files.times, stage);
  files.times.end_row();
  if (record.associations) associations(files, record);
}

/// The rows are those of observations.csv, one for one.
void Recorder::associations(EstimatorFiles& files, const UpdateRecord& record) const {
  if (!files.associations)
    files.associations.emplace(folder_ / (files.name + "_associations.csv"), "t,landmark");
  CsvWriter& file = *files.associations;
  if (record.associations->empty()) file.value(record.t).leave_empty().end_row();
  for (const seif::LandmarkId name : *record.associations) {
    file.value(record.t);
    name == seif::no_landmark ? file.leave_empty() : file.value(std::int64_t{name});
    file.end_row();
  }
}

void Recorder::consistency(std::size_t estimator, const ConsistencyRecord& record) {
  CsvWriter& file = estimators_.at(estimator).consistency;
  file.value(record.t);
  write_if_known(file, record.nees_pose);
  write_if_known(file, record.nees_landmark);
  file.value(std::int64_t{record.landmarks_scored}).value(std::int64_t{record.landmarks_mapped});
  file.value(record.memory_bytes).end_row();
}

void Recorder::map(std::size_t estimator, std::span<const MapRecord> landmarks) {
  CsvWriter file(folder_ / (estimators_.at(estimator).name + "_map.csv"),
                 "landmark,x,y,cov_xx,cov_xy,cov_yy");
  for (const MapRecord& landmark : landmarks) {
    file.value(std::int64_t{landmark.landmark}).value(landmark.mean.x()).value(landmark.mean.y());
    if (landmark.covariance) {
      write_covariance(file, *landmark.covariance);
    } else {
      file.leave_empty(3);
    }
    file.end_row();
  }
  file.close();
}

void Recorder::for_each_file(void (CsvWriter::*action)()) {
  (odometry_.*action)();
  (observations_.*action)();
  (dead_reckoning_.*action)();
  for (std::optional<CsvWriter>* file : {&true_ids_, &truth_, &truth_trajectory_}) {
    if (file->has_value()) (**file.*action)();
  }
  for (EstimatorFiles& files : estimators_) {
    for (CsvWriter* file : {&files.trajectory, &files.steps, &files.times, &files.consistency})
      (file->*action)();
    if (files.associations) (*files.associations.*action)();
  }
}

void Recorder::scored() { for_each_file(&CsvWriter::flush); }

void Recorder::close() { for_each_file(&CsvWriter::close); }

}  // namespace harness
