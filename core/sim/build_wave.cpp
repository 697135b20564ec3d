// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/build_wave.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"

namespace seaway::sim {
namespace {

using MeanFlow = waves::RegularWaveSpec::MeanFlow;

MeanFlow mean_flow_of(const Case& c) {
  return c.wave.mean_flow == Wave::MeanFlow::zero_eulerian ? MeanFlow::zero_eulerian : MeanFlow::zero_transport;
}

waves::RegularWaveSpec regular_of(const Case& c) {
  waves::RegularWaveSpec spec;
  switch (c.wave.theory) {
    case Wave::Theory::stream_function: spec.theory = waves::RegularWaveSpec::Theory::stream_function; break;
    case Wave::Theory::airy: spec.theory = waves::RegularWaveSpec::Theory::airy; break;
    case Wave::Theory::stokes_5: spec.theory = waves::RegularWaveSpec::Theory::stokes_5; break;
  }
  spec.mean_flow = mean_flow_of(c);
  spec.height = c.wave.height;
  spec.period = c.wave.period;
  spec.length = c.wave.length;
  spec.depth = -c.tank.lower.z();
  spec.heading = c.wave.heading;
  spec.phase = c.wave.phase;
  spec.gravity = c.fluids.gravity;
  spec.rho = c.fluids.rho_water;
  return spec;
}

double along_heading(const Wave& w) { return w.x * std::cos(w.heading) + w.y * std::sin(w.heading); }

/// Period of the component with the most energy for its width: that of the peak.
double peak_period_of(const std::vector<waves::Component>& sea) {
  const auto largest = std::max_element(sea.begin(), sea.end(), [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
  return 1 / largest->frequency;
}

}  // namespace

ElevationTable read_elevation_table(const std::string& file) {
  std::ifstream in(file);
  if (!in) fail(ErrorCode::not_found, "{} cannot be opened", file);
  ElevationTable out;
  std::string line;
  double first = 0, last = 0;
  for (int number = 1; std::getline(in, line); ++number) {
    std::replace(line.begin(), line.end(), ',', ' ');
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == line.npos || line[begin] == '#') continue;
    std::istringstream cells(line);
    double t = 0, elevation = 0;
    std::string rest;
    SEAWAY_CHECK((cells >> t >> elevation) && !(cells >> rest) && std::isfinite(t) && std::isfinite(elevation),
                 "{}:{}: must hold a time [s] and an elevation [m]", file, number);
    const auto n = out.elevation.size();
    if (n == 0) first = t;
    if (n == 1) out.step = t - first;
    if (n > 0)
      SEAWAY_CHECK(out.step > 0 && std::abs(t - last - out.step) <= 1e-3 * out.step, "{}:{}: the time {} s is {} s after the one before, the first step is {} s; steps must be equal",
                   file, number, t, t - last, out.step);
    last = t;
    out.elevation.push_back(elevation);
    SEAWAY_CHECK(out.elevation.size() <= 1'000'000, "{}: more than 1000000 lines", file);
  }
  SEAWAY_CHECK(out.elevation.size() >= 16, "{}: {} lines; at least 16 are needed", file, out.elevation.size());
  out.step = (last - first) / static_cast<double>(out.elevation.size() - 1);
  return out;
}

waves::SpectrumSpec spectrum_of(const Case& c) {
  const Wave::Spectrum& from = c.wave.spectrum;
  waves::SpectrumSpec spec;
  switch (from.shape) {
    case Wave::Spectrum::Shape::jonswap: spec.shape = waves::SpectrumSpec::Shape::jonswap; break;
    case Wave::Spectrum::Shape::bretschneider: spec.shape = waves::SpectrumSpec::Shape::bretschneider; break;
    case Wave::Spectrum::Shape::ittc: spec.shape = waves::SpectrumSpec::Shape::ittc; break;
    case Wave::Spectrum::Shape::pierson_moskowitz: spec.shape = waves::SpectrumSpec::Shape::pierson_moskowitz; break;
  }
  spec.peak_period = from.peak_period;
  spec.significant_height = c.wave.kind == Wave::Kind::focused ? 1 : c.wave.significant_height;
  spec.peak_enhancement = from.peak_enhancement;
  spec.n_components = from.components;
  spec.lower_cutoff = from.lower_cutoff;
  spec.upper_cutoff = from.upper_cutoff;
  spec.gravity = c.fluids.gravity;
  return spec;
}

waves::LinearSeaSpec sea_of(const Case& c) {
  const Wave& w = c.wave;
  waves::LinearSeaSpec sea;
  sea.mean_flow = mean_flow_of(c);
  sea.depth = -c.tank.lower.z();
  sea.heading = w.heading;
  sea.gravity = c.fluids.gravity;
  sea.rho = c.fluids.rho_water;
  if (w.kind == Wave::Kind::time_series) {
    const ElevationTable table = read_elevation_table((std::filesystem::path(c.folder) / w.file).string());
    sea.components = waves::components_of_series(table.elevation, table.step, w.time, w.lower_frequency, w.upper_frequency,
                                                 along_heading(w), sea.depth, sea.gravity);
    sea.peak_period = peak_period_of(sea.components);
    sea.height = waves::statistics(sea.components).significant_height;
    return sea;
  }
  const waves::SpectrumSpec spectrum = spectrum_of(c);
  sea.components = waves::make_components(spectrum, w.seed);
  sea.peak_period = spectrum.peak_period;
  sea.height = waves::significant_height_of(spectrum);
  if (w.kind == Wave::Kind::focused) {
    sea.components = waves::focus(sea.components, w.focus_amplitude, along_heading(w), w.time, sea.depth, sea.gravity);
    sea.height = 2 * std::abs(w.focus_amplitude);
    sea.bounded_by_sum = true;
  }
  return sea;
}

std::shared_ptr<const waves::WaveField> build_wave(const Case& c) {
  switch (c.wave.kind) {
    case Wave::Kind::none: return nullptr;
    case Wave::Kind::regular: return waves::make_wave(regular_of(c));
    case Wave::Kind::irregular:
    case Wave::Kind::focused:
    case Wave::Kind::time_series: return waves::make_linear_sea(sea_of(c));
  }
  fail(ErrorCode::internal, "unknown kind of wave {}", static_cast<int>(c.wave.kind));
}

}  // namespace seaway::sim
