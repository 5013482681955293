// Writes a run to its folder as it goes. The files are those of docs/log_format.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/csv_writer.hpp"
#include "harness/log_description.hpp"
#include "harness/stream.hpp"

namespace harness {

inline constexpr int stage_count = 4;  // [-] of seif::Stage

/// What an update cost. [us]
struct UpdateTimes {
  double update = 0.0;                                         // all of it
  std::array<std::optional<double>, stage_count> stages = {};  // those that the filter has
};

/// An estimator after an update: the motion since the last scan, and the scan.
struct UpdateRecord {
  double t = 0.0;                                 // [s]
  seif::Pose2 est_pose;                           // T_world_robot
  std::optional<Eigen::Matrix3d> est_covariance;  // (3 x 3) of the pose, where the filter has it at hand
  std::optional<seif::Pose2> true_pose;           // where it is known
  std::int64_t blocks_touched = 0;                // [-] by this update
  int active_landmarks = 0;                       // [-]
  std::int64_t links = 0;                         // [-]
  std::int64_t relocations = 0;                   // [-] so far
  std::optional<double> mean_residual;            // [-] as in seif::Counts
  std::optional<double> anchoring;                // [nat] so far
  UpdateTimes times;
};

/// How well an estimator's belief fits the truth, at a scoring time. NEES per degree of freedom: 1 is right.
struct ConsistencyRecord {
  double t = 0.0;                       // [s]
  std::optional<double> nees_pose;      // [-]
  std::optional<double> nees_landmark;  // [-] mean over the landmarks scored
  int landmarks_scored = 0;             // [-]
  int landmarks_mapped = 0;             // [-]
  std::int64_t memory_bytes = 0;        // [byte]
};

/// A landmark of a finished map.
struct MapRecord {
  seif::LandmarkId landmark = seif::no_landmark;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // p_world_landmark [m]
  std::optional<Eigen::Matrix2d> covariance;       // (2 x 2) [m^2]
};

/// All files of one run. Every function throws std::system_error if something cannot be written.
class Recorder {
 public:
  /// Creates the files in an empty folder and writes what is known at the start.
  Recorder(std::filesystem::path folder, const LogDescription& log, std::span<const std::string> estimators);

  void odometry(const OdometryEvent& event);
  void scan(const ScanEvent& event);
  void dead_reckoning(double t, const seif::Pose2& T_world_robot);
  void update(std::size_t estimator, const UpdateRecord& record);
  void consistency(std::size_t estimator, const ConsistencyRecord& record);

  /// Writes <estimator>_map.csv; once, at the end.
  void map(std::size_t estimator, std::span<const MapRecord> landmarks);

  /// Hands everything to the operating system: what was recorded survives the end of the program.
  void flush();
  void close();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct EstimatorFiles {
    std::string name;
    CsvWriter trajectory;
    CsvWriter steps;
    CsvWriter times;
    CsvWriter consistency;
  };

  EstimatorFiles open_estimator(const std::string& name) const;
  void truth(const std::optional<TruePose>& truth);
  void observation(double t, const seif::Observation& observation);
  void for_each_file(void (CsvWriter::*action)());

  std::filesystem::path folder_;
  bool has_wheel_angles_;
  CsvWriter odometry_;
  CsvWriter observations_;
  CsvWriter dead_reckoning_;
  std::optional<CsvWriter> true_ids_;
  std::optional<CsvWriter> truth_;
  std::optional<CsvWriter> truth_trajectory_;
  std::optional<double> last_truth_t_;
  std::vector<EstimatorFiles> estimators_;
};

}  // namespace harness
