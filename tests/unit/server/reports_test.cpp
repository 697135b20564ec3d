// SPDX-License-Identifier: GPL-3.0-or-later
// Runs with a known answer through the reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "proto/analysis_text.hpp"
#include "proto/rao_figure.hpp"
#include "proto/yaml.hpp"
#include "server/convert/input_error.hpp"
#include "server/reports/decay_report.hpp"
#include "server/reports/rao_report.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::reports {
namespace {

using ::testing::HasSubstr;

v1::Case small_case() {
  v1::Case m;
  yaml::read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", m);
  return m;
}

/// Beam waves to port, H 0.03 m, T 1.4 s: in the last stage the hull follows the wave, heaves with its elevation and
/// rolls with its slope where it drifts to; in the first stage it moves otherwise.
Run follower(double drift, double wave_number) {
  Run run;
  run.source = "jobs/a";
  run.title = "follower";
  run.message = small_case();
  run.has_case = true;
  History& h = run.history;
  h.channels = {{"heave", "m", {}}, {"roll", "deg", {}}, {"sway", "m", {}}, {"force_z", "N/m", {}}};
  const double omega = 2 * pi / 1.4, a = 0.015;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.01 * i;
    const bool last = t >= 10;
    h.times.push_back(t);
    h.stages.push_back(last ? 1 : 0);
    const double theta = wave_number * drift - omega * t;  // elevation a cos(theta)
    h.channels[0].values.push_back(last ? 0.002 + a * std::cos(theta) : 1);
    h.channels[1].values.push_back(last ? wave_number * a / degree * std::sin(theta) : 5);
    h.channels[2].values.push_back(drift);
    h.channels[3].values.push_back(3);
  }
  return run;
}

/// Of the wave itself, from the point's own length.
double wave_number_of_small_case() { return 2 * pi / make_rao_point(follower(0, 2), {}).wave_length_m(); }

TEST(RaoPoint, AHullThatFollowsTheWaveHasTransferFunctionsOfOne) {
  const double k = wave_number_of_small_case();
  for (const double drift : {0.0, 0.7, -2.3}) {
    const v1::RaoPoint p = make_rao_point(follower(drift, k), {});
    ASSERT_EQ(p.motions_size(), 2) << p.message();
    EXPECT_EQ(p.motions(0).channel(), "heave");
    EXPECT_NEAR(p.motions(0).rao(), 1, 1e-8);
    EXPECT_NEAR(p.motions(0).mean(), 0.002, 1e-9);
    EXPECT_NEAR(p.motions(0).phase_deg(), 0, 1e-6) << "with the crest at the place where it drifted to";
    EXPECT_NEAR(p.motions(1).rao(), 1, 1e-8);
    EXPECT_NEAR(p.motions(1).phase_deg(), 90, 1e-6) << "-sin(omega t) leads cos(omega t) by 90 degrees";
    EXPECT_NEAR(p.motions(1).per_metre(), k / degree, 1e-6);
    EXPECT_NEAR(p.motions(1).rao_scatter(), 0, 1e-8);
    EXPECT_EQ(p.period_count(), 5);
    EXPECT_NEAR(p.period_s(), 1.4, 1e-12);
    EXPECT_NEAR(p.wave_slope_deg(), k * 0.015 / degree, 1e-9);
  }
  const double omega = 2 * pi / 1.4;
  EXPECT_NEAR(k * 9.81 * std::tanh(0.9 * k), omega * omega, 0.005 * omega * omega) << "linear dispersion, but for the steepness";
}

TEST(RaoPoint, SaysWhyItHasNoNumbers) {
  reports::Run run = follower(0, 2);
  run.history.times.resize(1050);
  run.history.stages.resize(1050);
  for (auto& c : run.history.channels) c.values.resize(1050);
  EXPECT_THAT(make_rao_point(run, {}).message(), HasSubstr("less than one period"));
  EXPECT_EQ(make_rao_point(run, {}).motions_size(), 0);
  run = follower(0, 2);
  run.message.clear_wave();
  EXPECT_THAT(make_rao_point(run, {}).message(), HasSubstr("no regular wave"));
  run.has_case = false;
  EXPECT_THAT(make_rao_point(run, {}).message(), HasSubstr("case.yaml"));
  run = follower(0, 2);
  run.history.channels[0].values[2000] = std::nan("");
  EXPECT_THAT(make_rao_point(run, {}).message(), HasSubstr("not finite"));
  v1::RaoOptions many;
  many.set_period_count(12);
  EXPECT_EQ(make_rao_point(follower(0, 2), many).message(), "");
  many.set_period_count(40);
  EXPECT_THAT(make_rao_point(follower(0, 2), many).message(), HasSubstr("only 14 of 40 periods"));
  many.set_period_count(0);
  EXPECT_THROW(check_options(many), convert::InputError);
}

TEST(RaoReport, OrdersByCaseAndPeriodAndDrawsACurveForEachCase) {
  std::vector<v1::RaoPoint> points;
  for (const double period : {1.6, 1.2, 1.4})
    for (const char* name : {"intact", "damaged"}) {
      v1::RaoPoint p = make_rao_point(follower(0, 2), {});
      p.set_case_name(name);
      p.set_period_s(period);
      points.push_back(p);
    }
  const v1::RaoReport r = make_rao_report("title", points);
  EXPECT_EQ(r.points(0).case_name(), "damaged");
  EXPECT_EQ(r.points(0).period_s(), 1.2);
  EXPECT_EQ(r.points(5).case_name(), "intact");
  EXPECT_EQ(r.points(5).period_s(), 1.6);
  const Figure figure = rao_figure(r, "rao.png");
  EXPECT_EQ(figure.data.size(), 4u) << "two motions, two cases";
  EXPECT_THAT(figure.script, HasSubstr("title 'intact'"));
  EXPECT_THAT(report_text::rao_table(r), HasSubstr("1.200 s"));
  EXPECT_TRUE(rao_figure({}, "rao.png").script.empty());
}

TEST(DecayReport, ReadsARunFolderAndFindsWhatIsInIt) {
  testing::TempFolder folder;
  {
    std::ofstream out(folder / "history.csv");
    out << "sequence,stage,step,time [s],heave [m],roll [deg]\n";
    for (int i = 0; i < 1500; ++i) {
      const double t = 0.01 * i, s = std::max(t - 2, 0.0);
      out << i + 1 << ",0," << i << ',' << t << ",0," << 0.5 + 18.3 * std::exp(-0.12 * s) * std::cos(2 * pi * s / 1.5) << '\n';
    }
    out << "1501,0,15";  // a run that was killed in the middle of a line
  }
  const reports::Run run = read_run(folder.path());
  EXPECT_FALSE(run.has_case);
  EXPECT_EQ(run.history.times.size(), 1500u);
  const v1::DecayReport r = make_decay_report(run, {});
  EXPECT_EQ(r.unit(), "deg");
  EXPECT_NEAR(r.damped_cosine().period_s().value(), 1.5, 1e-4);
  EXPECT_NEAR(r.damped_cosine().mean().value(), 0.5, 1e-3);
  EXPECT_NEAR(r.peaks(0).time_s(), 2, 0.011) << "the release";
  EXPECT_NEAR(r.cycles(1).angle(), 18.3 * std::exp(-0.12 * 1.5), 0.02);
  EXPECT_TRUE(r.has_extinction());
  EXPECT_THAT(report_text::decay_table(r), HasSubstr("extinction: linear"));
  v1::DecayOptions options;
  options.set_channel("pitch");
  EXPECT_THROW(make_decay_report(run, options), Error);
  options.set_channel("heave");
  EXPECT_THROW(make_decay_report(run, options), Error) << "it does not move";
  options.set_smallest_peak(0.9);
  EXPECT_THROW(make_decay_report(run, options), convert::InputError);
}

TEST(History, WhatIsNoHistoryNamesFileAndLine) {
  testing::TempFolder folder;
  const auto message = [&](const std::string& text) {
    std::ofstream(folder / "h.csv") << text;
    try {
      read_history(folder / "h.csv");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("a,b\n1,2\n"), HasSubstr("h.csv:1: is no history"));
  EXPECT_THAT(message("time [s],heave [m]\n0,1\n1,x\n"), HasSubstr("h.csv:3: 'x' is no number"));
  EXPECT_THAT(message("time [s],heave [m]\n0,1\n0,1\n"), HasSubstr("h.csv:3: the time 0 s is not later"));
  EXPECT_THAT(message("time [ms],heave [m]\n0,1\n"), HasSubstr("must be in s"));
  EXPECT_THAT(message("time [s],heave [m]\n0,1,2\n"), HasSubstr("3 cells"));
  EXPECT_THROW(read_history(folder / "none.csv"), Error);
}

}  // namespace
}  // namespace seaway::reports
