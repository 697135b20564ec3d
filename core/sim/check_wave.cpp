// SPDX-License-Identifier: GPL-3.0-or-later
// Waves and zones: does the wave exist, does it fit the tank, can the zones make and absorb it.
#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/sim/build_wave.hpp"
#include "core/sim/findings.hpp"
#include "core/sim/tank_sides.hpp"

namespace seaway::sim {

namespace {

std::string tank_field(int axis) { return fmt::format("tank.{}_m", axis_names[axis]); }

void check_breaking(CheckState& s, double depth) {
  const Wave& w = s.c.wave;
  // Miche's limit of steepness of a progressive wave [miche1944].
  const double steepest = 0.142 * std::tanh(2 * pi * depth / s.wave_length);
  if (w.height > steepest * s.wave_length)
    s.findings.error(
        "wave.regular.height_m",
        fmt::format("{} m breaks: a wave {:.4g} m long in {:.4g} m of water reaches at most "
                    "{:.4g} m (0.142 tanh(kd) of its length)",
                    w.height, s.wave_length, depth, steepest * s.wave_length),
        "lower the wave or make it longer");
  if (w.theory == Wave::Theory::airy && w.height > 0.02 * s.wave_length)
    s.findings.warning(
        "wave.regular.theory",
        fmt::format("linear theory at steepness H/L = {:.3g}; it is good below about 0.02",
                    w.height / s.wave_length),
        "use the stream function theory");
}

void check_wave_fits(CheckState& s) {
  const Tank& tank = s.c.tank;
  const int axis = s.wave_axis;
  const double tank_length = tank.upper[axis] - tank.lower[axis];
  if (s.wave_crest > tank.upper.z())
    s.findings.error("tank.z_m",
                     fmt::format("the lid at {} m is too low for crests of up to {:.4g} m",
                                 tank.upper.z(), s.wave_crest),
                     "raise the upper end of the tank");
  if (s.wave_trough > -tank.lower.z())
    s.findings.error("tank.z_m",
                     fmt::format("the water is {} m deep, troughs reach down to {:.4g} m",
                                 -tank.lower.z(), s.wave_trough),
                     "lower the bottom of the tank");
  if (s.wave_length >
      1.05 * tank_length) {  // 5 %: the linear length is that much too short or long
    s.findings.error(tank_field(axis),
                     fmt::format("the tank is {:.4g} m long, the wave {:.4g} m; at least one "
                                 "wave must fit",
                                 tank_length, s.wave_length),
                     "lengthen the tank or shorten the wave");
  }
}

/// A tank that closes on itself must hold whole waves.
void check_whole_waves(CheckState& s) {
  const Tank& tank = s.c.tank;
  const Wave& w = s.c.wave;
  const int axis = s.wave_axis;
  const double tank_length = tank.upper[axis] - tank.lower[axis];
  if (s.wave_length <= 1.05 * tank_length && tank.periodic[static_cast<std::size_t>(axis)]) {
    const double n = tank_length / s.wave_length;
    const double tolerance = w.length > 0 ? 1e-6 : 0.05;
    if (std::abs(n - std::round(n)) > tolerance * std::round(n))
      s.findings.error(tank_field(axis),
                       fmt::format("a periodic tank of {:.6g} m holds {:.4g} waves of {:.6g} m; it "
                                   "must hold a whole number",
                                   tank_length, n, s.wave_length),
                       "make the tank a multiple of the wave length (give wave.regular.length_m)");
  }
}

/// A wave across the tank's corners comes in and goes out through all four sides.
void check_oblique(CheckState& s, const std::string& field) {
  Findings& f = s.findings;
  const Tank& tank = s.c.tank;
  const std::string what = fmt::format("{:.6g} degrees, so waves pass all four sides", s.c.wave.heading / degree);
  if (tank.periodic[0] || tank.periodic[1])
    f.error("tank.periodic", fmt::format("a heading of {}; a periodic tank has none", what), "remove the periodicity and give zones");
  if (s.c.zones.generation_length == 0 || s.c.zones.absorption_length == 0)
    f.error("zones", fmt::format("a heading of {}; those without a zone would send the wave back", what),
            "give zones.generation_length_m and zones.absorption_length_m");
  if (s.c.zones.absorption_target == Zones::Target::rest)
    f.error("zones.absorption_target", fmt::format("rest with {} of {}; the wave runs along the zones that it leaves through", field, what),
            "relax them towards the wave");
}

void check_heading(CheckState& s, const std::string& wave) {
  const Wave& w = s.c.wave;
  Findings& f = s.findings;
  const std::string field = wave + ".heading_deg";
  if (f.finite(field, w.heading)) {
    s.wave_axis = std::abs(std::cos(w.heading)) > std::abs(std::sin(w.heading)) ? 0 : 1;
    if (s.c.dim == 2 && std::abs(std::cos(w.heading)) > 1e-6)
      f.error(field,
              fmt::format("{:.6g} degrees; a section sees waves along y only: 90 or "
                          "-90",
                          w.heading / degree),
              "use 90 or -90");
    else if (is_oblique(s.c)) check_oblique(s, field);
  }
}

void check_regular_wave(CheckState& s) {
  const Wave& w = s.c.wave;
  Findings& f = s.findings;
  const int before = f.n_errors();
  f.positive("wave.regular.height_m", w.height);
  f.not_negative("wave.regular.period_s", w.period);
  f.not_negative("wave.regular.length_m", w.length);
  f.finite("wave.regular.phase_deg", w.phase);
  check_heading(s, "wave.regular");
  if (w.period > 0 && w.length > 0)
    f.error("wave.regular.period_s",
            fmt::format("period {} s and length {} m are both given; exactly one is "
                        "allowed, the other follows",
                        w.period, w.length),
            "remove period_s or length_m");
  if (w.period == 0 && w.length == 0)
    f.error("wave.regular.period_s", "neither period nor length is given; exactly one is needed",
            "add period_s or length_m");
  if (f.n_errors() > before || !s.tank_ok || !s.fluids_ok) return;
  const double depth = -s.c.tank.lower.z(), gravity = s.c.fluids.gravity;
  s.wave_length = w.length > 0 ? w.length : linear_wave_length(w.period, depth, gravity);
  s.wave_period = w.period > 0 ? w.period : linear_wave_period(w.length, depth, gravity);
  s.wave_ok = true;
  s.wave_height = w.height;
  // Crests of steep waves are higher than troughs are deep, by up to a third.
  s.wave_crest = 0.7 * w.height;
  s.wave_trough = 0.6 * w.height;
  check_breaking(s, depth);
  check_wave_fits(s);
  check_whole_waves(s);
  if (f.n_errors() > before) return;
  try {
    build_wave(s.c);
  } catch (const Error& error) {  // what a theory cannot do
    f.error("wave.regular", error.what(), "choose another theory or another wave");
  }
}

const char* path_of(Wave::Kind kind) {
  switch (kind) {
    case Wave::Kind::none: return "wave.calm";
    case Wave::Kind::regular: return "wave.regular";
    case Wave::Kind::irregular: return "wave.irregular";
    case Wave::Kind::focused: return "wave.focused";
    case Wave::Kind::time_series: return "wave.time_series";
  }
  return "wave";
}

/// What only makes sense if the wave repeats itself.
void check_no_cycles(CheckState& s, const std::string& path) {
  for (std::size_t i = 0; i < s.c.stages.size(); ++i)
    if (s.c.stages[i].end.kind == EndRule::Kind::converged)
      s.findings.error(fmt::format("cascade.stages[{}].end", i), fmt::format("waits for cycles that repeat themselves; {} has none", path),
                       "end the stage after a time");
  if (s.has_hull() && s.c.body.release == Body::Release::converged)
    s.findings.error("body.release", fmt::format("waits for cycles that repeat themselves; {} has none", path), "release at a time");
  if (s.c.tank.periodic[static_cast<std::size_t>(s.wave_axis)])
    s.findings.error("tank.periodic", fmt::format("a tank that is periodic in {} holds no {}", axis_names[s.wave_axis], path),
                     "remove the periodicity and give zones");
}

/// Cells in the shortest wave that is made, at the surface of the last stage.
void check_shortest_wave(CheckState& s, const waves::LinearSeaSpec& sea, const std::string& path) {
  double cell = s.c.base_cell;
  for (const SurfaceBand& band : s.c.stages.empty() ? std::vector<SurfaceBand>{} : s.c.stages.back().mesh.surface) cell = std::min(cell, band.cell);
  const double shortest = linear_wave_length(1 / sea.components.back().frequency, sea.depth, sea.gravity);
  if (s.base_cell_ok && cell > 0 && shortest < 12 * cell)
    s.findings.warning(path, fmt::format("its shortest waves are {:.4g} m long, {:.3g} cells of {:.4g} m; below about 12 they die out on the way",
                                         shortest, shortest / cell, cell),
                       "lower the upper cut-off or refine the surface");
}

void check_sea(CheckState& s) {
  const std::string path = path_of(s.c.wave.kind);
  check_heading(s, path);
  if (!s.tank_ok || !s.fluids_ok) return;
  try {
    const waves::LinearSeaSpec sea = sea_of(s.c);
    const auto wave = waves::make_linear_sea(sea);
    s.wave_length = wave->length();
    s.wave_period = wave->period();
    s.wave_height = wave->height();
    // Of a sea of some hundred waves; of a group the linear sum, and a third for what linear theory leaves out.
    s.wave_crest = s.wave_trough = s.c.wave.kind == Wave::Kind::focused ? 1.33 * wave->crest() : 1.2 * wave->height();
    s.wave_ok = true;
    check_shortest_wave(s, sea, path);
  } catch (const Error& error) {
    s.findings.error(path, error.what(), "change the sea or what is made of it");
    return;
  }
  check_no_cycles(s, path);
  check_wave_fits(s);
}

void check_zones(CheckState& s) {
  const Zones& z = s.c.zones;
  Findings& f = s.findings;
  const bool numbers = f.not_negative("zones.generation_length_m", z.generation_length) &
                       f.not_negative("zones.absorption_length_m", z.absorption_length);
  f.not_negative("zones.rate_per_s", z.rate);
  if (!numbers || !s.tank_ok) return;
  const double both = z.generation_length + z.absorption_length;
  const auto sides = tank_sides(s.c);
  bool periodic = false;
  for (int axis = 0; axis < 2; ++axis) {
    const auto& [lower, upper] = sides[static_cast<std::size_t>(axis)];
    if (s.c.dim == 2 && axis == 0) continue;
    if (axis != s.wave_axis && lower.zone + upper.zone == 0) continue;
    const double tank_length = s.c.tank.upper[axis] - s.c.tank.lower[axis];
    if (s.c.tank.periodic[static_cast<std::size_t>(axis)]) {
      periodic = true;
      if (both > 0)
        f.error("zones",
                fmt::format("zones of {} m in a tank that is periodic in {}; it has no ends", both,
                            axis_names[axis]),
                "remove the zones or the periodicity");
    }
    if (both >= tank_length)
      f.error(
          "zones.absorption_length_m",
          fmt::format("generation and absorption take {:.4g} m together, the tank is {:.4g} m long",
                      both, tank_length),
          "shorten the zones or lengthen the tank");
  }
  if (!s.wave_ok || periodic) return;
  if (z.generation_length == 0)
    f.warning("zones.generation_length_m",
              "0 m: no wave comes in behind the one that the tank starts with",
              "give at least half a wave length");
  if (z.absorption_length < 0.95 * s.wave_length)
    f.warning(
        "zones.absorption_length_m",
        fmt::format("{:.4g} m is shorter than the wave, {:.4g} m; waves come back from the end",
                    z.absorption_length, s.wave_length),
        "give at least one wave length");
}

}  // namespace

void check_wave_and_zones(CheckState& s) {
  if (s.c.wave.kind == Wave::Kind::regular) check_regular_wave(s);
  else if (s.c.wave.kind != Wave::Kind::none) check_sea(s);
  check_zones(s);
}

}  // namespace seaway::sim
