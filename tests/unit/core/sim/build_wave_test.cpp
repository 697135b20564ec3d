// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/build_wave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/base/error.hpp"
#include "core/sim/check_case.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/core/sim/example_case.hpp"

namespace seaway::sim {
namespace {

using ::testing::HasSubstr;

Case in_sea() {
  Case c = damaged_section_in_waves();
  c.wave = {};
  c.wave.kind = Wave::Kind::irregular;
  c.wave.significant_height = 0.061;
  c.wave.spectrum.peak_period = 1.4;
  for (Stage& stage : c.stages) {
    stage.end.kind = EndRule::Kind::time;
    stage.end.duration = 10;
  }
  c.body.release = Body::Release::at_start;
  return c;
}

std::string errors_of(const Case& c) {
  std::string out;
  for (const Diagnostic& d : check_case(c).diagnostics)
    if (d.severity == Diagnostic::Severity::error) out += d.field + ": " + d.message + "\n";
  return out;
}

TEST(BuildWave, SeasAreChecked) {
  EXPECT_EQ(errors_of(in_sea()), "");
  Case c = in_sea();
  c.wave.significant_height = 0.3;
  EXPECT_THAT(errors_of(c), HasSubstr("wave.irregular: waves of up to 0.558 m are beyond breaking"));
  c = in_sea();
  c.wave.spectrum.peak_period = 12;
  EXPECT_THAT(errors_of(c), HasSubstr("at least one wave must fit"));
  c = in_sea();
  c.stages.back().end.kind = EndRule::Kind::converged;
  EXPECT_THAT(errors_of(c), HasSubstr("waits for cycles that repeat themselves"));
  c = in_sea();
  c.body.release = Body::Release::converged;
  EXPECT_THAT(errors_of(c), HasSubstr("body.release: waits for cycles"));
  c = in_sea();
  c.wave.significant_height = 0.01;
  EXPECT_THAT(errors_of(c), HasSubstr("cells of")) << "fewer than six in Hs";
  c = in_sea();
  c.wave.kind = Wave::Kind::focused;
  c.wave.focus_amplitude = 0.05;
  EXPECT_EQ(errors_of(c), "");
  c.wave.focus_amplitude = 0.5;
  EXPECT_THAT(errors_of(c), HasSubstr("wave.focused: waves of up to 1 m are beyond breaking"));
}

TEST(BuildWave, ATheoryThatCannotDoTheWaveIsRefusedBeforeTheRun) {
  Case c = damaged_section_in_waves();
  c.wave.theory = Wave::Theory::stokes_5;
  EXPECT_EQ(errors_of(c), "");
  c.tank.lower.z() = -0.2;
  c.wave.height = 0.1;
  c.wave.period = 2;
  c.wave.length = 0;
  EXPECT_THAT(errors_of(c), HasSubstr("wave.regular: "));
}

TEST(BuildWave, ATableOfElevationsIsReadOrRefusedByLine) {
  testing::TempFolder folder;
  Case c = in_sea();
  c.wave.kind = Wave::Kind::time_series;
  c.wave.file = folder / "gauge.csv";
  c.wave.y = 0.4;
  c.wave.lower_frequency = 0.4;
  c.wave.upper_frequency = 1.5;
  EXPECT_THAT(errors_of(c), HasSubstr("gauge.csv cannot be opened"));
  {
    std::ofstream out(folder / "gauge.csv");
    out << "# time s, elevation m\n";
    for (int i = 0; i < 560; ++i) out << 0.05 * i << ", " << 0.02 * std::cos(2 * pi * 0.05 * i / 1.4) << '\n';  // 20 periods
  }
  EXPECT_EQ(errors_of(c), "");
  const auto wave = build_wave(c);
  EXPECT_NEAR(wave->period(), 1.4, 1e-9);
  EXPECT_NEAR(wave->elevation(0, 0.4, 7), 0.02, 1e-6);
  EXPECT_NEAR(wave->elevation(0, 0.4, 7.35), 0, 1e-6);
  std::ofstream(folder / "gauge.csv") << "0 1\n0.1 1\n0.3 1\n";
  EXPECT_THAT(errors_of(c), HasSubstr("gauge.csv:3: the time 0.3 s"));
  std::ofstream(folder / "gauge.csv") << "0 1\nhello\n";
  EXPECT_THAT(errors_of(c), HasSubstr("gauge.csv:2: must hold a time"));
}

}  // namespace
}  // namespace seaway::sim
