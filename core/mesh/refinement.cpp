#include "core/mesh/refinement.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace seaway::mesh {
namespace {

template <int Dim>
Vec<Dim> root_cell(const TankGrid<Dim>& grid) {
  Vec<Dim> h;
  for (int a = 0; a < Dim; ++a)
    h[a] = (grid.upper[a] - grid.lower[a]) / (grid.root_blocks[a] * BlockShape<Dim>::n);
  return h;
}

}  // namespace

template <int Dim>
int level_for_cell(const Vec<Dim>& base, double cell) {
  SEAWAY_CHECK(cell > 0, "a wanted cell is {} m; it must be positive", cell);
  int level = 0;
  double h = std::max(base[Dim - 2], base[Dim - 1]);
  while (h > 1.121 * cell) {
    h *= 0.5;
    ++level;
    SEAWAY_CHECK(level <= 14, "a cell of {} m is more than 14 halvings of the base cell {} m; "
                 "use a smaller base cell", cell, std::max(base[Dim - 2], base[Dim - 1]));
  }
  return level;
}

template <int Dim>
int finest_level(const TankGrid<Dim>& grid, const std::vector<RefinedBox<Dim>>& boxes) {
  int level = 0;
  for (const auto& box : boxes) level = std::max(level, level_for_cell<Dim>(root_cell(grid), box.cell));
  return level;
}

template <int Dim>
RefineRule<Dim> refine_boxes(const TankGrid<Dim>& grid, std::vector<RefinedBox<Dim>> boxes) {
  struct Wanted {
    RefinedBox<Dim> box;
    int level;
  };
  std::vector<Wanted> wanted;
  for (auto& box : boxes) wanted.push_back({box, level_for_cell<Dim>(root_cell(grid), box.cell)});
  return [wanted](const Vec<Dim>& lower, const Vec<Dim>& upper, int level) {
    return std::any_of(wanted.begin(), wanted.end(), [&](const Wanted& w) {
      return level < w.level && (lower.array() < w.box.upper.array()).all() &&
             (upper.array() > w.box.lower.array()).all();
    });
  };
}

template int level_for_cell<2>(const Vec<2>&, double);
template int level_for_cell<3>(const Vec<3>&, double);
template int finest_level<2>(const TankGrid<2>&, const std::vector<RefinedBox<2>>&);
template int finest_level<3>(const TankGrid<3>&, const std::vector<RefinedBox<3>>&);
template RefineRule<2> refine_boxes<2>(const TankGrid<2>&, std::vector<RefinedBox<2>>);
template RefineRule<3> refine_boxes<3>(const TankGrid<3>&, std::vector<RefinedBox<3>>);

}  // namespace seaway::mesh
