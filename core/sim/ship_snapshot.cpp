#include "core/sim/ship_snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/flow/plane_cut.hpp"
#include "core/hull/surface_cut.hpp"
#include "core/hull/surface_hull.hpp"
#include "core/io/whole_file.hpp"

namespace seaway::sim {
namespace {

using mesh::BlockShape;
using nlohmann::json;

bool in_solid(const Simulation<3>& s, const Vec3& x) {
  const auto& m = s.model();
  return m.hull && m.hull->signed_distance(motion::earth_to_hull<3>(m.body, s.body().pose, x)) < 0;
}

/// f(lower corner, cell edges, plane, block, cell) for every cell with a surface outside the hull's solid.
template <class F>
void for_surface_cells(Simulation<3>& s, F&& f) {
  s.planes().reconstruct(s.state().vof);
  for (const int b : s.forest().leaves()) {
    if (s.planes().phase(b) != flow::BlockPhase::mixed) continue;
    const auto& block = s.forest().block(b);
    field::for_box<3>(field::filled<3>(0), field::cells_upper<3>(), [&](const IVec<3>& i) {
      const int cell = field::offset<3>(i, field::cell_strides<3>());
      if (!flow::is_mixed(s.state().vof.block(b)[cell])) return;
      const Vec3 centre = block.cell_centre(i);
      if (in_solid(s, centre)) return;
      f(Vec3(centre - 0.5 * block.h), block.h, s.planes().plane(b, cell), b, cell);
    });
  }
}

/// The hull's outline in the plane x_axis = at of the earth axes: closed lines of its other two axes.
json hull_outline(const Simulation<3>& s, int axis, double at) {
  json lines = json::array();
  const auto* hull = dynamic_cast<const hull::SurfaceHull*>(s.model().hull.get());
  if (hull == nullptr) return lines;
  const auto& body = s.model().body;
  const auto& pose = s.body().pose;
  const Vec3 normal = motion::rotation(pose).transpose() * Vec3::Unit(axis);
  const double d = at - pose.cog[axis] + normal.dot(body.cog);
  for (const auto& solid : hull->solids()) {
    if (solid->weight() < 0.999 && solid->weight() > -0.999) continue;  // porous spaces are no walls
    for (const auto& loop : hull::cut_surface(solid->surface(), normal, d)) {
      json points = json::array();
      for (const Vec3& x : loop) {
        const Vec3 y = motion::hull_to_earth<3>(body, pose, x);
        points.push_back({y[axis == 0 ? 1 : 0], y[axis == 2 ? 1 : 2]});
      }
      lines.push_back(points);
    }
  }
  return lines;
}

}  // namespace

io::PolygonMesh free_surface(Simulation<3>& s) {
  io::PolygonMesh out;
  auto& elevation = out.values["elevation"];
  const bool turbulent = s.state().turbulent();
  auto* tke = turbulent ? &out.values["tke"] : nullptr;
  auto* nu_t = turbulent ? &out.values["nu_t"] : nullptr;
  for_surface_cells(s, [&](const Vec3& low, const Vec3& h, const flow::Plane<3>& plane, int b, int cell) {
    std::vector<int> polygon;
    for (const auto& p : flow::cut_unit_cell(plane)) {
      const Vec3 x = low + Vec3(p[0] * h[0], p[1] * h[1], p[2] * h[2]);
      polygon.push_back(static_cast<int>(out.points.size()));
      out.points.push_back(x);
      elevation.push_back(x[2]);
      if (!turbulent) continue;
      tke->push_back(s.state().tke.block(b)[cell]);
      nu_t->push_back(s.turbulence()->nu_t().block(b)[cell]);
    }
    if (!polygon.empty()) out.polygons.push_back(std::move(polygon));
  });
  return out;
}

io::PolygonMesh hull_mesh(const Simulation<3>& s) {
  io::PolygonMesh out;
  const auto* hull = dynamic_cast<const hull::SurfaceHull*>(s.model().hull.get());
  if (hull == nullptr) return out;
  for (const auto& solid : hull->solids()) {
    const int first = static_cast<int>(out.points.size());
    for (const Vec3& x : solid->surface().vertices)
      out.points.push_back(motion::hull_to_earth<3>(s.model().body, s.body().pose, x));
    for (const auto& t : solid->surface().triangles)
      out.polygons.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return out;
}

void write_section(Simulation<3>& s, double x, int stage, const std::string& path) {
  const auto& grid = s.model().grid;
  json out;
  out["time_s"] = s.time();
  out["stage"] = stage;
  out["x_m"] = x;
  out["bounds"]["y"] = {grid.lower[1], grid.upper[1]};
  out["bounds"]["z"] = {grid.lower[2], grid.upper[2]};
  json surface = json::array();
  for_surface_cells(s, [&](const Vec3& low, const Vec3& h, const flow::Plane<3>& plane, int, int) {
    const double at = (x - low[0]) / h[0];
    if (at < 0 || at >= 1) return;
    json segment = json::array();
    for (const auto& p : flow::cut_unit_cell(flow::section_of(plane, 0, at)))
      segment.push_back({low[1] + p[0] * h[1], low[2] + p[1] * h[2]});
    if (!segment.empty()) surface.push_back(segment);
  });
  out["surface"] = surface;
  out["hull"] = hull_outline(s, 0, x);
  io::write_whole_file(path, {out.dump()});
}

void write_plan(Simulation<3>& s, int stage, int squares, const std::string& path) {
  const auto& grid = s.model().grid;
  const double wide = grid.upper[0] - grid.lower[0], long_side = grid.upper[1] - grid.lower[1];
  const double edge = std::max(std::sqrt(wide * long_side / std::max(squares, 1)), s.forest().finest_cell());
  const int nx = std::max(1, static_cast<int>(std::lround(wide / edge)));
  const int ny = std::max(1, static_cast<int>(std::lround(long_side / edge)));
  const double dx = wide / nx, dy = long_side / ny;
  std::vector<double> heights(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  mesh::parallel_for(ny, s.forest().threads(), [&](int j) {
    for (int i = 0; i < nx; ++i) {
      const double x = grid.lower[0] + (i + 0.5) * dx, y = grid.lower[1] + (j + 0.5) * dy;
      heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i)] =
          in_solid(s, Vec3(x, y, 0)) ? std::nan("") : s.elevation(x, y);
    }
  });
  json out;
  out["time_s"] = s.time();
  out["stage"] = stage;
  out["x"] = {{"first", grid.lower[0] + 0.5 * dx}, {"step", dx}, {"count", nx}};
  out["y"] = {{"first", grid.lower[1] + 0.5 * dy}, {"step", dy}, {"count", ny}};
  json rows = json::array();
  for (int j = 0; j < ny; ++j) {
    json row = json::array();
    for (int i = 0; i < nx; ++i) {
      const double z = heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i)];
      if (std::isfinite(z)) row.push_back(std::round(1e5 * z) / 100);
      else row.push_back(nullptr);
    }
    rows.push_back(std::move(row));
  }
  out["elevation_mm"] = std::move(rows);
  out["waterline"] = hull_outline(s, 2, 0.0);
  io::write_whole_file(path, {out.dump()});
}

}  // namespace seaway::sim
