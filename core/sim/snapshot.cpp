#include "core/sim/snapshot.hpp"

#include <nlohmann/json.hpp>

#include "core/flow/plane_cut.hpp"
#include "core/hull/section_hull.hpp"
#include "core/io/whole_file.hpp"

namespace seaway::sim {

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
  io::write_whole_file(path, {out.dump()});
}

}  // namespace seaway::sim
