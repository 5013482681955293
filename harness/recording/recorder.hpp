// Writes a run to its folder while it runs. The files are described in docs/log_format.md.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/csv_writer.hpp"
#include "harness/stream/log_description.hpp"
#include "harness/stream/run_listener.hpp"
#include "harness/stream/stream.hpp"

namespace harness {

inline constexpr std::string_view no_header;  // TUM files have none

/// Writes a row of a TUM file: t x y z and the quaternion x y z w.
void write_pose(CsvWriter& file, double t, const seif::Pose2& T_world_robot);

/// All files of one run. Every function throws std::system_error if something cannot be written.
class Recorder final : public RunListener {
 public:
  /// Creates the files in an empty folder and writes what is known before the first event.
  Recorder(std::filesystem::path folder, const LogDescription& log, std::span<const std::string> estimators);

  void odometry(const OdometryEvent& event) override;
  void scan(const ScanEvent& event) override;
  void dead_reckoning(double t, const seif::Pose2& T_world_robot) override;
  void update(std::size_t estimator, const UpdateRecord& record) override;
  void consistency(std::size_t estimator, const ConsistencyRecord& record) override;
  /// Flushes all files to the operating system. The record up to here survives the end of the program.
  void scored() override;
  /// Writes `ESTIMATOR_map.csv`.
  void map(std::size_t estimator, std::span<const MapRecord> landmarks) override;

  void close();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct EstimatorFiles {
    std::string name;
    CsvWriter trajectory;
    CsvWriter steps;
    CsvWriter times;
    CsvWriter consistency;
    std::optional<CsvWriter> associations = {};  // for an estimator that names landmarks by itself
  };

  EstimatorFiles open_estimator(const std::string& name) const;
  void truth(const std::optional<TruePose>& truth);
  void observation(double t, const seif::Observation& observation);
  void associations(EstimatorFiles& files, const UpdateRecord& record) const;
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
