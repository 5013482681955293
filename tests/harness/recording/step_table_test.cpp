#include "harness/recording/step_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "harness/files/csv_reader.hpp"
#include "harness/files/csv_writer.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {
namespace {

UpdateRecord example() {
  UpdateRecord record;
  record.t = 0.5;
  record.est_pose = {2.0, 3.0, 0.25};
  record.true_pose = seif::Pose2{1.5, 3.5, 0.125};
  record.blocks_touched = 7;
  record.counts = {.blocks_touched = 100,
                   .relocations = 4,
                   .gated = 5,
                   .weakened = 6,
                   .active_landmarks = 2,
                   .links = 3,
                   .mean_residual = 0.75,
                   .anchoring = 0.0625,
                   .innovation = 8.5,
                   .innovation_degrees = 10};
  return record;
}

// Programs of other people read this table.
TEST(StepTable, HasTheseColumns) {
  EXPECT_EQ(step_header(),
            "t,error_x,error_y,error_theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,blocks_touched,"
            "active_landmarks,links,relocations,mean_residual,anchoring,gated,innovation,innovation_degrees,"
            "weakened");
}

TEST(StepTable, EachValueIsReadUnderTheColumnThatItWasWrittenTo) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "seif_steps.csv";
  CsvWriter file(path, step_header());
  write_step(file, example());
  file.close();

  CsvReader rows(path, step_columns());
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.number(step_t), 0.5);
  EXPECT_EQ(rows.number(step_error_x), 0.5);
  EXPECT_EQ(rows.number(step_error_y), -0.5);
  EXPECT_EQ(rows.number(step_error_theta), 0.125);
  EXPECT_TRUE(rows.is_empty(step_cov_xx) && rows.is_empty(step_cov_tt));
  EXPECT_EQ(rows.number(step_blocks_touched), 7.0) << "by this update alone";
  EXPECT_EQ(rows.number(step_active_landmarks), 2.0);
  EXPECT_EQ(rows.number(step_links), 3.0);
  EXPECT_EQ(rows.number(step_relocations), 4.0);
  EXPECT_EQ(rows.number(step_mean_residual), 0.75);
  EXPECT_EQ(rows.number(step_anchoring), 0.0625);
  EXPECT_EQ(rows.number(step_gated), 5.0);
  EXPECT_EQ(rows.number(step_innovation), 8.5);
  EXPECT_EQ(rows.number(step_innovation_degrees), 10.0);
  EXPECT_EQ(rows.number(step_weakened), 6.0);
}

TEST(StepTable, LeavesEmptyWhatIsNotKnown) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "seif_steps.csv";
  CsvWriter file(path, step_header());
  UpdateRecord record = example();
  record.true_pose.reset();
  record.counts.innovation.reset();
  write_step(file, record);
  file.close();

  CsvReader rows(path, step_columns());
  ASSERT_TRUE(rows.next());
  for (const int column : {step_error_x, step_error_theta, step_cov_xy, step_innovation})
    EXPECT_TRUE(rows.is_empty(column)) << column;
  EXPECT_EQ(rows.number(step_weakened), 6.0);
}

}  // namespace
}  // namespace harness
