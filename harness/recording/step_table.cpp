#include "harness/recording/step_table.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "harness/recording/cells.hpp"

namespace harness {
namespace {

void write_error(CsvWriter& file, const UpdateRecord& record) {
  if (!record.true_pose) {
    file.leave_empty(3);
    return;
  }
  file.value(record.est_pose.x - record.true_pose->x).value(record.est_pose.y - record.true_pose->y);
  file.value(seif::wrap_angle(record.est_pose.theta - record.true_pose->theta));
}

}  // namespace

const Columns& step_columns() {
  static const Columns columns = {
      {"t", "error_x", "error_y", "error_theta", "cov_xx", "cov_xy", "cov_xt", "cov_yy", "cov_yt", "cov_tt",
       "blocks_touched", "active_landmarks", "links", "relocations", "mean_residual", "anchoring"},
      {"gated"},
      {"innovation", "innovation_degrees", "weakened"}};
  return columns;
}

std::string step_header() {
  const Columns& columns = step_columns();
  return fmt::format("{},{},{}", fmt::join(columns.required, ","), fmt::join(columns.optional, ","),
                     fmt::join(columns.newer, ","));
}

void write_step(CsvWriter& file, const UpdateRecord& record) {
  const seif::Counts& counts = record.counts;
  file.value(record.t);
  write_error(file, record);
  if (record.est_covariance) {
    write_covariance(file, *record.est_covariance);
  } else {
    file.leave_empty(6);
  }
  file.value(record.blocks_touched).value(std::int64_t{counts.active_landmarks}).value(counts.links);
  file.value(counts.relocations);
  write_if_known(file, counts.mean_residual);
  write_if_known(file, counts.anchoring);
  file.value(counts.gated);
  write_if_known(file, counts.innovation);
  file.value(std::int64_t{counts.innovation_degrees}).value(counts.weakened).end_row();
}

}  // namespace harness
