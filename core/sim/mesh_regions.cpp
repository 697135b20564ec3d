#include "core/sim/mesh_regions.hpp"

#include <cmath>
#include <limits>

#include "core/motion/rigid_body.hpp"

namespace seaway::sim {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

template <int Dim>
mesh::RefinedBox<Dim> swept_region(const MeshRule& rule, const HullPlace<Dim>& hull) {
  mesh::RefinedBox<Dim> box{Vec<Dim>::Constant(inf), Vec<Dim>::Constant(-inf), rule.hull_cell};
  for (int step = -8; step <= 8; ++step) {
    motion::Angles angles;
    angles.roll = rule.hull_sweep * step / 8.0;
    const auto pose = motion::make_pose<Dim>(hull.start, angles);
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      Vec<Dim> x;
      for (int a = 0; a < Dim; ++a)
        x[a] = ((corner >> a) & 1) ? hull.bounds.upper[a] : hull.bounds.lower[a];
      const Vec<Dim> y = motion::to_earth<Dim>(pose, x - hull.cog);
      box.lower = box.lower.cwiseMin(y);
      box.upper = box.upper.cwiseMax(y);
    }
  }
  const double margin = rule.hull_margin > 0 ? rule.hull_margin : 8 * rule.hull_cell;
  const double heave = rule.hull_heave > 0 ? rule.hull_heave : 0.25 * hull.draft;
  box.lower.array() -= margin;
  box.upper.array() += margin;
  box.lower[Dim - 1] -= heave;
  box.upper[Dim - 1] += heave;
  return box;
}

}  // namespace

template <int Dim>
mesh::TankGrid<Dim> tank_grid(const Case& c) {
  std::array<bool, Dim> periodic{};
  for (int a = 0; a < Dim; ++a)
    periodic[static_cast<std::size_t>(a)] = c.tank.periodic[static_cast<std::size_t>(a + 3 - Dim)];
  return mesh::make_tank_grid<Dim>(from_vec3<Dim>(c.tank.lower), from_vec3<Dim>(c.tank.upper), c.base_cell, periodic, c.stretch_x);
}

template <int Dim>
std::vector<mesh::RefinedBox<Dim>> refined_regions(const MeshRule& rule,
                                                   const std::optional<HullPlace<Dim>>& hull) {
  std::vector<mesh::RefinedBox<Dim>> boxes;
  Vec<Dim> centre = Vec<Dim>::Zero(), reach = Vec<Dim>::Zero();
  if (hull) {
    centre = hull->start;
    reach = 0.5 * (hull->bounds.upper - hull->bounds.lower);
    if (rule.hull_cell > 0) boxes.push_back(swept_region<Dim>(rule, *hull));
  }
  for (const SurfaceBand& band : rule.surface) {
    mesh::RefinedBox<Dim> box{Vec<Dim>::Constant(-inf), Vec<Dim>::Constant(inf), band.cell};
    for (int a = 0; a + 1 < Dim; ++a) {
      if (!std::isfinite(band.within)) continue;
      box.lower[a] = centre[a] - reach[a] - band.within;
      box.upper[a] = centre[a] + reach[a] + band.within;
    }
    box.lower[Dim - 1] = -band.half_height;
    box.upper[Dim - 1] = band.half_height;
    boxes.push_back(box);
  }
  for (const RefinementBox& b : rule.boxes)
    boxes.push_back({from_vec3<Dim>(b.lower), from_vec3<Dim>(b.upper), b.cell});
  return boxes;
}

template mesh::TankGrid<2> tank_grid<2>(const Case&);
template mesh::TankGrid<3> tank_grid<3>(const Case&);
template std::vector<mesh::RefinedBox<2>> refined_regions<2>(const MeshRule&,
                                                             const std::optional<HullPlace<2>>&);
template std::vector<mesh::RefinedBox<3>> refined_regions<3>(const MeshRule&,
                                                             const std::optional<HullPlace<3>>&);

}  // namespace seaway::sim
