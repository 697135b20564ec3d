#include "core/sim/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/flow/plane_cut.hpp"
#include "core/hull/section_hull.hpp"
#include "core/io/whole_file.hpp"

namespace seaway::sim {
namespace {

/// k and nu_t of the cells at the points of a regular grid: about the hull, or of the whole tank.
nlohmann::json turbulence_about_hull(const Simulation<2>& s) {
  constexpr int points = 10000;
  const auto& forest = s.forest();
  const Model<2>& model = s.model();
  Vec2 lower = model.grid.lower, upper = model.grid.upper;
  if (model.hull) {
    const auto bounds = model.hull->bounds();
    const double reach = (bounds.upper - bounds.lower).maxCoeff();
    lower = lower.cwiseMax(s.body().pose.cog - Vec2::Constant(reach));
    upper = upper.cwiseMin(s.body().pose.cog + Vec2::Constant(reach));
  }
  const Vec2 size = upper - lower;
  const double edge = std::max(std::sqrt(size.prod() / points), forest.finest_cell());
  nlohmann::json out;
  std::array<int, 2> n{};
  for (int a = 0; a < 2; ++a) {
    n[static_cast<std::size_t>(a)] = std::max(1, static_cast<int>(std::lround(size[a] / edge)));
    const double step = size[a] / n[static_cast<std::size_t>(a)];
    out[a == 0 ? "y" : "z"] = {{"first", lower[a] + 0.5 * step}, {"step", step}, {"count", n[static_cast<std::size_t>(a)]}};
  }
  for (int j = 0; j < n[1]; ++j) {
    nlohmann::json tke = nlohmann::json::array(), nu_t = nlohmann::json::array();
    for (int i = 0; i < n[0]; ++i) {
      const Vec2 x(lower[0] + (i + 0.5) * size[0] / n[0], lower[1] + (j + 0.5) * size[1] / n[1]);
      const int b = forest.find_leaf(x);
      const auto& block = forest.block(b);
      IVec<2> cell{};
      for (int a = 0; a < 2; ++a)
        cell[static_cast<std::size_t>(a)] =
            std::clamp(static_cast<int>((x[a] - block.origin[a]) / block.h[a]), 0, mesh::BlockShape<2>::n - 1);
      const int at = field::offset<2>(cell, field::cell_strides<2>());
      tke.push_back(static_cast<float>(s.state().tke.block(b)[at]));
      nu_t.push_back(static_cast<float>(s.turbulence()->nu_t().block(b)[at]));
    }
    out["tke_m2_per_s2"].push_back(std::move(tke));
    out["nu_t_m2_per_s"].push_back(std::move(nu_t));
  }
  return out;
}

}  // namespace

void write_section(Simulation<2>& s, int stage, const std::string& path) {
  const auto& forest = s.forest();
  const Model<2>& model = s.model();
  nlohmann::json out;
  out["time_s"] = s.time();
  out["stage"] = stage;
  out["bounds"]["y"] = {model.grid.lower[0], model.grid.upper[0]};
  out["bounds"]["z"] = {model.grid.lower[1], model.grid.upper[1]};
  nlohmann::json surface = nlohmann::json::array();
  s.planes().reconstruct(s.state().vof);
  for (const int b : forest.leaves()) {
    if (s.planes().phase(b) != flow::BlockPhase::mixed) continue;
    const auto& block = forest.block(b);
    for (int cell = 0; cell < mesh::BlockShape<2>::cells; ++cell) {
      if (!flow::is_mixed(s.state().vof.block(b)[cell])) continue;
      const IVec<2> i{cell % mesh::BlockShape<2>::n, cell / mesh::BlockShape<2>::n};
      const Vec2 low = block.cell_centre(i) - 0.5 * block.h;
      if (model.hull && model.hull->signed_distance(motion::earth_to_hull<2>(model.body, s.body().pose, block.cell_centre(i))) < 0)
        continue;
      const auto points = flow::cut_unit_cell(s.planes().plane(b, cell));
      if (points.empty()) continue;
      nlohmann::json segment = nlohmann::json::array();
      for (const auto& p : points) segment.push_back({low[0] + p[0] * block.h[0], low[1] + p[1] * block.h[1]});
      surface.push_back(segment);
    }
  }
  out["surface"] = surface;
  nlohmann::json loops = nlohmann::json::array();
  if (const auto* section = dynamic_cast<const hull::SectionHull*>(model.hull.get())) {
    for (const auto& loop : section->section().solid) {
      if (loop.weight < 0.999 && loop.weight > -0.999) continue;  // porous spaces are no walls
      nlohmann::json points = nlohmann::json::array();
      for (const Vec2& x : loop.points) {
        const Vec2 y = motion::hull_to_earth<2>(model.body, s.body().pose, x);
        points.push_back({y[0], y[1]});
      }
      loops.push_back(points);
    }
  }
  out["hull"] = loops;
  if (s.turbulence()) out["turbulence"] = turbulence_about_hull(s);
  io::write_whole_file(path, {out.dump()});
}

}  // namespace seaway::sim
