// The table ESTIMATOR_steps.csv of a run folder: the error and the counts of each update. Whoever adds a count to
// seif::Counts adds its column here.
#pragma once

#include <string>

#include "harness/files/csv_reader.hpp"
#include "harness/files/csv_writer.hpp"
#include "harness/stream/run_listener.hpp"

namespace harness {

/// The columns in their order. The columns from `gated` on are absent from logs of older versions.
enum StepColumn : int {
  step_t,
  step_error_x,
  step_error_y,
  step_error_theta,
  step_cov_xx,
  step_cov_xy,
  step_cov_xt,
  step_cov_yy,
  step_cov_yt,
  step_cov_tt,
  step_blocks_touched,
  step_active_landmarks,
  step_links,
  step_relocations,
  step_mean_residual,
  step_anchoring,
  step_gated,
  step_innovation,
  step_innovation_degrees,
  step_weakened
};

const Columns& step_columns();

/// The names of all columns between commas.
std::string step_header();

/// One row. Cells of what is not known stay empty.
void write_step(CsvWriter& file, const UpdateRecord& record);

}  // namespace harness
