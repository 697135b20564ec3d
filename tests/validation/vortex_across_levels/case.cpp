// [vortex_across_levels] A vortex carried through a patch of finer cells; see README.md beside this file.
#include <fmt/format.h>

#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"

namespace seaway::validation {
namespace {

constexpr double radius = 0.08, swirl = 0.5;  // [m], largest velocity of the vortex over that of the flow
constexpr Vec2::Scalar start_y = 0.25, start_z = -0.5;

/// Velocity of the vortex about (y, z) = (start_y + t, start_z) in the periodic box, without the flow of speed 1.
double vortex(const Vec2& x, int axis, double t) {
  double y = x[0] - start_y - t;
  y -= std::round(y);
  const double z = x[1] - start_z;
  const double factor = swirl / radius * std::exp(0.5 - 0.5 * (y * y + z * z) / (radius * radius));
  return axis == 0 ? -factor * z : factor * y;
}

/// Rms error of the velocity over that of the vortex when it is back after one box length.
double error_on(int cells, bool patch, int threads) {
  const double h = 1.0 / cells;
  sim::Case c = one_fluid_tank(0, -1, cells, cells, h, 1e-6);
  c.tank.periodic = {false, true, true};
  c.fluids.gravity = 0;  // periodic upwards as well
  c.fluids.viscous = false;
  c.numerics.pressure_tolerance = 1e-8;
  if (patch) c.stages.front().mesh.boxes = {{0.5 * h, {0, 0.501, -0.749}, {0, 0.749, -0.251}}};
  const int steps = cells * cells / 32;  // with the square of the cell: the error of the step, first order, goes along
  c.time.dt = 1.0 / steps;
  const auto run = start(c, threads);
  const auto exact = [](double t) {
    return [t](const Vec2& x, int axis) { return vortex(x, axis, t) + (axis == 0 ? 1.0 : 0.0); };
  };
  set_velocity(*run, exact(0));
  for (int i = 0; i < steps; ++i) step(*run);
  double error = 0, scale = 0;
  for (int axis = 0; axis < 2; ++axis)
    each_face(*run, axis, [&](int b, int entry, const Vec2& x) {
      const double area = run->forest().block(b).h.prod(), there = exact(1)(x, axis);
      error += area * std::pow(run->state().u.block(axis, b)[entry] - there, 2);
      scale += area * std::pow(vortex(x, axis, 1), 2);
    });
  return std::sqrt(error / scale);
}

}  // namespace

void run_vortex_across_levels(const Context& context, Results& results) {
  const std::vector<int> meshes = context.quick() ? std::vector<int>{64, 128} : std::vector<int>{64, 128, 256};
  Refinement with{"error_with_patch", "1", {}, {}, 2, 0.0}, without{"error_uniform", "1", {}, {}, 2, 0.0};
  for (const int cells : meshes) {
    for (Refinement* r : {&with, &without}) {
      r->h.push_back(1.0 / cells);
      r->value.push_back(error_on(cells, r == &with, context.threads));
      results.report(fmt::format("{}_{}", r->quantity, cells), r->value.back(), "1");
    }
  }
  const std::size_t n = meshes.size();
  results.expect_above("order", std::log2(with.value[n - 2] / with.value[n - 1]), "1", 1);
  results.expect_below("ratio_to_uniform", with.value.back() / without.value.back(), "1", 1.1);
  results.refinement(with);
  results.refinement(without);
}

}  // namespace seaway::validation
