// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/report_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/history_csv.hpp"

namespace seaway {
namespace {

using ::testing::HasSubstr;

TEST(ReportText, ShowsStagesAsColumns) {
  google::protobuf::RepeatedPtrField<v1::StageReport> stages;
  v1::StageReport& a = *stages.Add();
  a.set_name("coarse");
  a.set_cell_count(1234567);
  a.set_finished(true);
  auto& phase = *a.add_phases();
  phase.set_phase("pressure");
  phase.set_cpu_s(1.5);
  auto& roll = *a.add_motions();
  roll.set_channel("roll");
  roll.set_unit("deg");
  roll.set_amplitude(17.4);
  stages.Add()->set_name("fine");
  const std::string text = report_text::stage_table(stages);
  EXPECT_THAT(text, HasSubstr("1 234 567"));
  EXPECT_THAT(text, HasSubstr("CPU s pressure"));
  EXPECT_THAT(text, HasSubstr("17.40 deg"));
  EXPECT_THAT(text, HasSubstr("..."));
}

TEST(ReportText, SaysDurations) {
  EXPECT_EQ(report_text::duration(5.25), "5.2 s");
  EXPECT_EQ(report_text::duration(75), "1 min 15 s");
  EXPECT_EQ(report_text::duration(3 * 3600 + 120), "3 h 2 min");
}

TEST(HistoryCsv, KeepsEveryBit) {
  google::protobuf::RepeatedPtrField<v1::ChannelSchema> channels;
  channels.Add()->set_name("heave");
  channels[0].set_unit("m");
  v1::SampleChunk chunk;
  chunk.set_first_sequence(7);
  chunk.add_stages(1);
  chunk.add_steps(9);
  chunk.add_times_s(0.1);
  chunk.add_columns()->add_values(1.0 / 3.0);
  std::string text = history_csv::header(channels);
  history_csv::append(chunk, text);
  EXPECT_EQ(text, "sequence,stage,step,time [s],heave [m]\n7,1,9,0.1,0.3333333333333333\n");
  EXPECT_EQ(std::stod("0.3333333333333333"), 1.0 / 3.0);
}

}  // namespace
}  // namespace seaway
