// SPDX-License-Identifier: GPL-3.0-or-later
// Waves of a case, back into the message with every default written out.
#include "core/base/constants.hpp"
#include "server/convert/case_parts.hpp"

namespace seaway::convert {
namespace {

v1::RegularWave::MeanFlow mean_flow(const sim::Wave& w) {
  return static_cast<v1::RegularWave::MeanFlow>(static_cast<int>(w.mean_flow) + 1);
}

void put_regular(const sim::Wave& w, v1::RegularWave& m) {
  m.set_height_m(w.height);
  if (w.period > 0)
    m.set_period_s(w.period);
  else
    m.set_length_m(w.length);
  m.set_theory(static_cast<v1::RegularWave::Theory>(static_cast<int>(w.theory) + 1));
  m.set_mean_flow(mean_flow(w));
  m.set_heading_deg(w.heading / degree);
  m.set_phase_deg(w.phase / degree);
}

void put_spectrum(const sim::Wave::Spectrum& s, v1::WaveSpectrum& m) {
  m.set_shape(static_cast<v1::WaveSpectrum::Shape>(static_cast<int>(s.shape) + 1));
  m.set_peak_period_s(s.peak_period);
  if (s.shape == sim::Wave::Spectrum::Shape::jonswap) m.set_peak_enhancement(s.peak_enhancement);
  m.set_component_count(s.components);
  m.set_lower_cutoff(s.lower_cutoff);
  m.set_upper_cutoff(s.upper_cutoff);
}

void put_irregular(const sim::Wave& w, v1::IrregularWave& m) {
  put_spectrum(w.spectrum, *m.mutable_spectrum());
  if (w.significant_height > 0) m.set_significant_height_m(w.significant_height);
  m.set_seed(w.seed);
  m.set_mean_flow(mean_flow(w));
  m.set_heading_deg(w.heading / degree);
}

void put_focused(const sim::Wave& w, v1::FocusedGroup& m) {
  put_spectrum(w.spectrum, *m.mutable_spectrum());
  m.set_amplitude_m(w.focus_amplitude);
  m.set_focus_time_s(w.time);
  m.set_focus_x_m(w.x);
  m.set_focus_y_m(w.y);
  m.set_mean_flow(mean_flow(w));
  m.set_heading_deg(w.heading / degree);
}

void put_time_series(const sim::Wave& w, v1::WaveTimeSeries& m) {
  m.set_file(w.file);
  m.set_x_m(w.x);
  m.set_y_m(w.y);
  m.set_start_time_s(w.time);
  m.set_lower_cutoff_hz(w.lower_frequency);
  m.set_upper_cutoff_hz(w.upper_frequency);
  m.set_mean_flow(mean_flow(w));
  m.set_heading_deg(w.heading / degree);
}

}  // namespace

void put_wave(const sim::Wave& w, v1::Wave& m) {
  switch (w.kind) {
    case sim::Wave::Kind::none: m.mutable_calm(); break;
    case sim::Wave::Kind::regular: put_regular(w, *m.mutable_regular()); break;
    case sim::Wave::Kind::irregular: put_irregular(w, *m.mutable_irregular()); break;
    case sim::Wave::Kind::focused: put_focused(w, *m.mutable_focused()); break;
    case sim::Wave::Kind::time_series: put_time_series(w, *m.mutable_time_series()); break;
  }
}

}  // namespace seaway::convert
