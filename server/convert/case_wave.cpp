// SPDX-License-Identifier: GPL-3.0-or-later
// Waves of a case.
#include <fmt/format.h>

#include <cmath>

#include "server/convert/case_parts.hpp"

namespace seaway::convert {
namespace {

void read_mean_flow(v1::RegularWave::MeanFlow flow, sim::Wave& wave) {
  if (flow == v1::RegularWave::MEAN_FLOW_ZERO_EULERIAN) wave.mean_flow = sim::Wave::MeanFlow::zero_eulerian;
}

template <class Message>
void read_heading(const Message& m, const std::string& path, int dim, sim::Wave& wave, Checker& check) {
  if (!m.has_heading_deg()) return;
  wave.heading = check.number(path + "heading_deg", m.heading_deg(), {-360, 360}) * degree;
  if (dim == 2 && std::abs(m.heading_deg()) != 90)
    check.problem(path + "heading_deg", fmt::format("{} is not possible in a section", m.heading_deg()),
                  "write 90 (towards port) or -90 (towards starboard)");
}

void read_regular(const v1::RegularWave& m, int dim, sim::Wave& wave, Checker& check) {
  const std::string path = "wave.regular.";
  wave.kind = sim::Wave::Kind::regular;
  wave.height = check.number(path + "height_m", m.height_m(), positive);
  std::string given;
  const auto count = [&](bool has, const char* name) {
    if (has) given += (given.empty() ? "" : " and ") + std::string(name);
  };
  count(m.has_period_s(), "period_s");
  count(m.has_frequency_hz(), "frequency_hz");
  count(m.has_length_m(), "length_m");
  if (m.has_period_s() + m.has_frequency_hz() + m.has_length_m() != 1)
    check.problem("wave.regular", given.empty() ? "has no period" : given + " are given",
                  "give exactly one of period_s, frequency_hz and length_m");
  if (m.has_period_s()) wave.period = check.number(path + "period_s", m.period_s(), positive);
  if (m.has_frequency_hz()) wave.period = 1 / check.number(path + "frequency_hz", m.frequency_hz(), {1e-6, 1e6});
  if (m.has_length_m()) wave.length = check.number(path + "length_m", m.length_m(), positive);
  if (m.theory() == v1::RegularWave::THEORY_AIRY) wave.theory = sim::Wave::Theory::airy;
  if (m.theory() == v1::RegularWave::THEORY_STOKES_5) wave.theory = sim::Wave::Theory::stokes_5;
  read_mean_flow(m.mean_flow(), wave);
  read_heading(m, path, dim, wave, check);
  if (m.has_phase_deg()) wave.phase = check.number(path + "phase_deg", m.phase_deg(), {-360, 360}) * degree;
}

void read_spectrum(const v1::WaveSpectrum& m, const std::string& path, sim::Wave::Spectrum& s, Checker& check) {
  using Shape = sim::Wave::Spectrum::Shape;
  switch (m.shape()) {
    case v1::WaveSpectrum::SHAPE_JONSWAP: s.shape = Shape::jonswap; break;
    case v1::WaveSpectrum::SHAPE_BRETSCHNEIDER: s.shape = Shape::bretschneider; break;
    case v1::WaveSpectrum::SHAPE_ITTC: s.shape = Shape::ittc; break;
    case v1::WaveSpectrum::SHAPE_PIERSON_MOSKOWITZ: s.shape = Shape::pierson_moskowitz; break;
    default: check.problem(path + "shape", "is missing", "write jonswap, bretschneider, ittc or pierson_moskowitz");
  }
  if (m.peak_period_s() == 0)
    check.problem(path + "peak_period_s", "is missing", "give the period of the spectrum's peak; Tz and Te follow from it");
  else
    s.peak_period = check.number(path + "peak_period_s", m.peak_period_s(), positive);
  if (m.has_peak_enhancement()) {
    if (m.shape() != v1::WaveSpectrum::SHAPE_JONSWAP)
      check.problem(path + "peak_enhancement", "has no effect on this spectrum", "remove it, or write shape: jonswap");
    s.peak_enhancement = check.number(path + "peak_enhancement", m.peak_enhancement(), {1, 10});
  }
  if (m.has_component_count()) s.components = check.count(path + "component_count", m.component_count(), 10, 1000);
  if (m.has_lower_cutoff()) s.lower_cutoff = check.number(path + "lower_cutoff", m.lower_cutoff(), {0.3, 0.95});
  if (m.has_upper_cutoff()) s.upper_cutoff = check.number(path + "upper_cutoff", m.upper_cutoff(), {1.2, 6});
}

void read_irregular(const v1::IrregularWave& m, int dim, sim::Wave& wave, Checker& check) {
  const std::string path = "wave.irregular.";
  wave.kind = sim::Wave::Kind::irregular;
  read_spectrum(m.spectrum(), path + "spectrum.", wave.spectrum, check);
  const bool fixed = m.spectrum().shape() == v1::WaveSpectrum::SHAPE_PIERSON_MOSKOWITZ;
  if (fixed && m.has_significant_height_m())
    check.problem(path + "significant_height_m", "is fixed by the peak period in a Pierson-Moskowitz spectrum",
                  "remove it, or write shape: bretschneider, which has both");
  if (!fixed && !m.has_significant_height_m())
    check.problem(path + "significant_height_m", "is missing", "give Hs of the whole spectrum in metres");
  if (m.has_significant_height_m()) wave.significant_height = check.number(path + "significant_height_m", m.significant_height_m(), positive);
  if (m.has_seed()) wave.seed = m.seed();
  read_mean_flow(m.mean_flow(), wave);
  read_heading(m, path, dim, wave, check);
}

void read_focused(const v1::FocusedGroup& m, int dim, sim::Wave& wave, Checker& check) {
  const std::string path = "wave.focused.";
  wave.kind = sim::Wave::Kind::focused;
  read_spectrum(m.spectrum(), path + "spectrum.", wave.spectrum, check);
  if (m.amplitude_m() == 0)
    check.problem(path + "amplitude_m", "is missing", "give the height of the crest, or minus the depth of the trough");
  wave.focus_amplitude = check.number(path + "amplitude_m", m.amplitude_m(), any_finite);
  wave.time = m.focus_time_s();
  wave.x = m.focus_x_m();
  wave.y = m.focus_y_m();
  read_mean_flow(m.mean_flow(), wave);
  read_heading(m, path, dim, wave, check);
}

void read_time_series(const v1::WaveTimeSeries& m, int dim, sim::Wave& wave, Checker& check) {
  const std::string path = "wave.time_series.";
  wave.kind = sim::Wave::Kind::time_series;
  wave.file = m.file();
  if (m.file().empty()) check.problem(path + "file", "is missing", "name the table of time and elevation");
  wave.x = m.x_m();
  wave.y = m.y_m();
  wave.time = m.start_time_s();
  wave.lower_frequency = check.number(path + "lower_cutoff_hz", m.lower_cutoff_hz(), positive);
  wave.upper_frequency = check.number(path + "upper_cutoff_hz", m.upper_cutoff_hz(), {m.lower_cutoff_hz(), 1e6, true});
  read_mean_flow(m.mean_flow(), wave);
  read_heading(m, path, dim, wave, check);
}

}  // namespace

void read_wave(const v1::Wave& m, int dim, sim::Wave& wave, Checker& check) {
  switch (m.kind_case()) {
    case v1::Wave::kCalm: break;
    case v1::Wave::kRegular: read_regular(m.regular(), dim, wave, check); break;
    case v1::Wave::kIrregular: read_irregular(m.irregular(), dim, wave, check); break;
    case v1::Wave::kFocused: read_focused(m.focused(), dim, wave, check); break;
    case v1::Wave::kTimeSeries: read_time_series(m.time_series(), dim, wave, check); break;
    case v1::Wave::KIND_NOT_SET:
      check.problem("wave", "says nothing", "write calm: {}, or regular, irregular, focused or time_series with their fields");
  }
}

}  // namespace seaway::convert
