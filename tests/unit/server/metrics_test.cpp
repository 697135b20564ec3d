// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/metrics/metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seaway::metrics {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Metrics, HasTheFixedNamesAndTypes) {
  Metrics metrics;
  metrics.stage_finished(0, {{"pressure", 1.0}});
  const std::string text = metrics.text({{{"QUEUED", 0}}, {{"samples", 0}}, 0, 0, 0});
  for (const char* line : {"# TYPE seaway_jobs gauge", "# TYPE seaway_queue_wait_seconds histogram", "# TYPE seaway_stage_seconds histogram",
                           "# TYPE seaway_steps_total counter", "# TYPE seaway_cell_updates_per_second gauge",
                           "# TYPE seaway_commit_seconds histogram", "# TYPE seaway_wal_bytes gauge", "# TYPE seaway_streams gauge",
                           "# TYPE seaway_stream_lag_samples gauge", "# TYPE seaway_checkpoint_seconds histogram",
                           "# TYPE seaway_recoveries_total counter", "# TYPE seaway_disk_free_bytes gauge"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(Metrics, CountsWhatItIsTold) {
  Metrics metrics;
  metrics.job_waited(5);
  metrics.job_waited(-1);  // the clock was set back
  metrics.stage_finished(2, {{"pressure", 30}, {"mesh", 0.5}});
  metrics.stage_finished(2, {{"pressure", 40}});
  metrics.stepped(100, 3000);
  metrics.stepped(20, 3000);
  metrics.committed(0.003);
  metrics.checkpoint_written(0.7);
  metrics.recovered(3);
  const std::string text = metrics.text({{{"RUNNING", 2}, {"FAILED", 1}}, {{"samples", 4}}, 17, 4096, 1e9});
  for (const char* line : {"seaway_queue_wait_seconds_bucket{le=\"0.1\"} 1\n", "seaway_queue_wait_seconds_sum 5\n",
                           "seaway_stage_seconds_count{phase=\"pressure\",stage=\"2\"} 2\n", "seaway_stage_seconds_sum{phase=\"pressure\",stage=\"2\"} 70\n",
                           "seaway_stage_seconds_sum{phase=\"mesh\",stage=\"2\"} 0.5\n", "seaway_steps_total 120\n",
                           "seaway_cell_updates_per_second 12000\n", "seaway_commit_seconds_bucket{le=\"0.005\"} 1\n",
                           "seaway_commit_seconds_bucket{le=\"0.002\"} 0\n", "seaway_checkpoint_seconds_count 1\n",
                           "seaway_recoveries_total 3\n", "seaway_jobs{state=\"RUNNING\"} 2\n", "seaway_streams{kind=\"samples\"} 4\n",
                           "seaway_stream_lag_samples 17\n", "seaway_wal_bytes 4096\n", "seaway_disk_free_bytes 1000000000\n"})
    EXPECT_THAT(text, HasSubstr(line));
  const std::string later = metrics.text({{{"RUNNING", 0}}, {}, 0, 0, 0});
  EXPECT_THAT(later, HasSubstr("seaway_jobs{state=\"RUNNING\"} 0\n"));
  EXPECT_THAT(later, Not(HasSubstr("job=")));
}

}  // namespace
}  // namespace seaway::metrics
