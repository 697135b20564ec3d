#include "tests/validation/support/one_fluid.hpp"

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"

namespace seaway::validation {

using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;

sim::Case one_fluid_tank(double y_lower, double z_lower, int cells, int cells_up, double h, double nu) {
  sim::Case c;
  c.title = "one fluid";
  c.base_cell = h;
  c.tank.lower = {0, y_lower, z_lower};
  c.tank.upper = {0, y_lower + cells * h, z_lower + cells_up * h};
  c.tank.open_top = false;
  c.fluids.rho_air = c.fluids.rho_water;
  c.fluids.nu_air = c.fluids.nu_water = nu;
  sim::Stage stage;
  stage.name = "only";
  stage.end.duration = 1;
  c.stages = {stage};
  return c;
}

void each_face(const Section& run, int axis, const std::function<void(int, int, const Vec2&)>& f) {
  for (const int b : run.forest().leaves())
    for_box<2>(filled<2>(0), faces_upper<2>(axis), [&](const IVec<2>& i) {
      f(b, offset<2>(i, face_strides<2>(axis)), run.forest().block(b).face_centre(i, axis));
    });
}

void each_cell(const Section& run, const std::function<void(int, int, const Vec2&)>& f) {
  for (const int b : run.forest().leaves())
    for_box<2>(filled<2>(0), field::cells_upper<2>(), [&](const IVec<2>& i) {
      f(b, offset<2>(i, field::cell_strides<2>()), run.forest().block(b).cell_centre(i));
    });
}

void set_velocity(Section& run, const std::function<double(const Vec2&, int)>& f) {
  for (int axis = 0; axis < 2; ++axis)
    each_face(run, axis, [&](int b, int entry, const Vec2& x) { run.state().u.block(axis, b)[entry] = f(x, axis); });
  field::restrict_faces<double, 2>(run.forest(), run.state().u);
  run.state().w = run.state().u;
}

double relative_velocity_error(const Section& run, const std::function<double(const Vec2&, int)>& f) {
  double error = 0, scale = 0;
  for (int axis = 0; axis < 2; ++axis)
    each_face(run, axis, [&](int b, int entry, const Vec2& x) {
      const double exact = f(x, axis);
      error += std::pow(run.state().u.block(axis, b)[entry] - exact, 2);
      scale += exact * exact;
    });
  return std::sqrt(error / scale);
}

double velocity_at(const Section& run, int axis, const Vec2& x) {
  constexpr int n = mesh::BlockShape<2>::n;
  const auto& grid = run.forest().grid();
  const Vec2 h = run.forest().cell_size(0);
  IVec<2> base{};
  Vec2 part;
  for (int a = 0; a < 2; ++a) {
    const double at = (x[a] - grid.lower[a]) / h[a] - (a == axis ? 0.0 : 0.5);
    const int last = grid.root_blocks[a] * n - (a == axis ? 1 : 2);
    base[a] = std::clamp(static_cast<int>(std::floor(at)), 0, last);
    part[a] = at - base[a];
  }
  double sum = 0;
  for (int corner = 0; corner < 4; ++corner) {
    IVec<2> i = base, coord{};
    double weight = 1;
    for (int a = 0; a < 2; ++a) {
      const int up = (corner >> a) & 1;
      i[a] += up;
      weight *= up ? part[a] : 1 - part[a];
      coord[a] = std::min(i[a] / n, grid.root_blocks[a] - 1);
      i[a] -= coord[a] * n;
    }
    sum += weight * run.state().u.block(axis, run.forest().find(0, coord))[offset<2>(i, face_strides<2>(axis))];
  }
  return sum;
}

}  // namespace seaway::validation
