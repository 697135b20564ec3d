#include "core/sim/ship_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/surface_cut.hpp"

namespace seaway::sim {

namespace {

constexpr int n_drafts = 10;
constexpr double last_heel = 70 * degree, heel_step = 2.5 * degree;

ShipCondition condition(const hull::Solid& solid, double volume, const Vec3& cog) {
  ShipCondition out;
  out.rest = hull::find_equilibrium(solid, volume, cog, true, true);
  std::vector<double> heels;
  for (int i = 0; heel_step * i <= last_heel + 1e-9; ++i) heels.push_back(heel_step * i);
  out.righting = hull::righting_curve(solid, volume, cog, heels, true);
  double last = 0, last_at = 0;
  bool ended = false;
  for (const auto& [heel, lever] : out.righting) {
    if (!ended && heel > 0 && lever < 0 && last > 0) {
      out.range = last_at + (heel - last_at) * last / (last - lever);
      ended = true;
    }
    if (!ended && lever > out.largest_lever) {
      out.largest_lever = lever;
      out.heel_of_largest = heel;
    }
    last = lever;
    last_at = heel;
  }
  if (!ended) out.range = last_at;
  return out;
}

/// Size of the waterline on even keel.
void measure_waterline(const hull::Ship& ship, ShipReport& r) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const auto& loop : hull::cut_surface(ship.outer, Vec3::UnitZ(), r.at_draft->draft))
    for (const Vec3& x : loop) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  if (low.x() > high.x()) return;
  r.length_waterline = high.x() - low.x();
  r.breadth_waterline = high.y() - low.y();
  const double block = r.length_waterline * r.breadth_waterline * r.at_draft->draft;
  if (block > 0) r.block_coefficient = r.at_draft->water.volume / block;
}

}  // namespace

ShipReport ship_report(const hull::Ship& ship, const LoadCondition& load) {
  ShipReport r;
  r.bounds = hull::bounds_of(ship.outer);
  r.n_triangles = static_cast<int>(ship.outer.triangles.size());
  r.enclosed_volume = hull::enclosed_volume(ship.outer);
  const std::vector<bool> closed(ship.compartments.size(), false);
  const hull::Solid intact = hull::buoyant_surfaces(ship, closed);
  const double height = r.bounds.upper.z() - r.bounds.lower.z();
  for (int i = 1; i <= n_drafts; ++i) {
    const double draft = r.bounds.lower.z() + height * i / n_drafts;
    if (draft > 0) r.drafts.push_back({draft, hull::hydrostatics(intact, {draft, 0, 0})});
  }
  double volume = load.mass / load.rho;
  std::optional<double> draft;
  if (load.draft > 0) draft = load.draft;
  if (!draft && volume > 0) {
    draft = hull::find_waterline(intact, 0, 0, volume);
    SEAWAY_CHECK(draft, "a mass of {} kg cannot float: the hull displaces at most {:.6g} kg", load.mass,
                 load.rho * r.enclosed_volume);
  }
  if (!draft) return r;
  r.at_draft = DraftRow{*draft, hull::hydrostatics(intact, {*draft, 0, 0})};
  measure_waterline(ship, r);
  if (!(volume > 0)) volume = r.at_draft->water.volume;
  if (!load.cog || !(volume > 0)) return r;
  r.intact = condition(intact, volume, *load.cog);
  if (std::find(load.open.begin(), load.open.end(), true) == load.open.end()) return r;
  r.damaged = condition(hull::buoyant_surfaces(ship, load.open), volume, *load.cog);
  for (std::size_t i = 0; i < load.open.size(); ++i) {
    if (!load.open[i]) continue;
    const hull::ShipCompartment& c = ship.compartments[i];
    const auto water = hull::hydrostatics({{c.space, 1.0}}, r.damaged->rest.at);
    r.damaged->flood.push_back({c.name, c.permeability * water.volume, water.buoyancy_centre});
  }
  return r;
}

}  // namespace seaway::sim
