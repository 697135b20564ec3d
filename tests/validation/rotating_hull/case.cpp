// [rotating_hull] An ellipse turning in a fluid at rest: added inertia, momentum and energy; see README.md.
#include <fmt/format.h>

#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

constexpr double a = 0.2, b = 0.1;  // half axes [m]
constexpr double box = 3.2;         // edge of the periodic box [m]
constexpr double rho = 1000;
constexpr double amplitude = 5 * degree, period = 1, ramp = 0.5;
constexpr double arm = 0.2;         // of the axis from the ellipse's middle, in the runs with a net force [m]

/// Moment over angular acceleration of an ellipse about its middle, unbounded fluid [lamb1932].
double added_inertia() { return pi / 8 * rho * std::pow(a * a - b * b, 2); }
/// Force over acceleration of a translation across its long axis.
double added_mass_across() { return pi * rho * a * a; }

/// The ellipse as a polygon of its area; it turns about a point `off` beside its middle, along its long axis.
sim::Case turning_ellipse(int cells_in_b, double off) {
  const double h = b / cells_in_b;
  sim::Case c = one_fluid_tank(-0.5 * box, -0.5 * box + 0.37 * h, static_cast<int>(box / 0.1), static_cast<int>(box / 0.1), 0.1, 1e-6);
  c.tank.periodic = {false, true, true};
  c.fluids.gravity = 0;
  c.fluids.viscous = false;
  c.fluids.rho_water = c.fluids.rho_air = rho;
  c.numerics.pressure_tolerance = 1e-8;
  c.hull.shape = sim::Hull::Shape::polygon;
  constexpr int corners = 96;
  const double grow = std::sqrt(2 * pi / corners / std::sin(2 * pi / corners));
  for (int i = 0; i <= corners; ++i) {
    const double s = 2 * pi * (i % corners) / corners;
    c.hull.vertices.push_back({grow * a * std::cos(s), b + grow * b * std::sin(s)});
  }
  c.body.mass = 10;
  c.body.cog = {0, off, b};
  c.body.gyradii = {0.1, 0, 0};
  c.body.draft = b;  // the middle at z = 0
  c.body.prescribed = {{sim::Dof::roll, amplitude, period, ramp}};
  c.time.dt = period / (20 * cells_in_b);
  c.stages.front().mesh.hull_cell = h;
  c.stages.front().mesh.hull_sweep = 2 * amplitude;
  c.stages.front().mesh.hull_heave = 0.02;
  return c;
}

/// Momentum of fluid and hull volume together, all of density rho: sum of rho w over the box.
Vec2 momentum_of(const Section& run) {
  Vec2 sum = Vec2::Zero();
  for (int axis = 0; axis < 2; ++axis)
    each_face(run, axis, [&](int block, int entry, const Vec2& x) {
      const auto& bl = run.forest().block(block);
      // Faces between two leaves come twice: half a cell from each.
      const double in = (x[axis] - bl.origin[axis]) / bl.h[axis];
      const bool side = in < 0.25 || in > mesh::BlockShape<2>::n - 0.25;
      sum[axis] += (side ? 0.5 : 1.0) * rho * bl.h.prod() * run.state().w.block(axis, block)[entry];
    });
  return sum;
}

struct Balance {
  double inertia = 0;   ///< least squares of -moment over angular acceleration [kg m2 / m]
  double work = 0;      ///< of the hull on the fluid over a whole cycle, over the largest kinetic energy
  double impulse = 0;   ///< largest |change of momentum - impulse of the hull|, over the largest impulse
};

Balance turn(int cells_in_b, double off, int threads) {
  const auto run = start(turning_ellipse(cells_in_b, off), threads);
  const motion::PrescribedMotion roll{motion::Dof::roll, amplitude, period, ramp};
  const double area = pi * a * b;
  Balance out;
  double top = 0, square = 0, energy = 0;
  Vec2 impulse = Vec2::Zero();
  double worst = 0, largest = 0;
  const Vec2 before = momentum_of(*run);
  const double cog_to_middle = -off;
  const auto hull_momentum = [&] {  // of the hull's volume filled with fluid, moving with it
    const double angle = run->body().half_pose.roll, speed = run->body().twist[2];
    return Vec2(rho * area * speed * cog_to_middle * Vec2(-std::sin(angle), std::cos(angle)));
  };
  const Vec2 hull_before = hull_momentum();
  while (run->time() < ramp + 2 * period) {
    step(*run);
    const double t = run->time(), dt = run->dt(), e = 1e-4;
    const double acceleration = (roll.velocity(t + e) - roll.velocity(t - e)) / (2 * e);
    const double moment = run->load()[2];
    impulse -= dt * run->load().head<2>();  // the kick of this step ends half a step after t, where w is
    const Vec2 fluid = momentum_of(*run) - before - (hull_momentum() - hull_before);
    worst = std::max(worst, (fluid - impulse).norm());
    largest = std::max(largest, impulse.norm());
    if (t < ramp) continue;
    top -= moment * acceleration;
    square += acceleration * acceleration;
    energy -= dt * moment * roll.velocity(t);
  }
  out.inertia = top / square;
  const double speed = amplitude * 2 * pi / period;
  out.work = energy / (0.5 * (added_inertia() + off * off * added_mass_across()) * speed * speed);
  out.impulse = worst / largest;
  return out;
}

}  // namespace

void run_rotating_hull(const Context& context, Results& results) {
  const std::vector<int> meshes = context.quick() ? std::vector<int>{4, 8} : std::vector<int>{8, 16, 32};
  Refinement inertia{"added_inertia", "kg m", {}, {}, 1, added_inertia()}, impulse{"momentum_error", "1", {}, {}, 1, 0.0};
  for (const int cells : meshes) {
    const Balance centred = turn(cells, 0, context.threads), aside = turn(cells, arm, context.threads);
    inertia.h.push_back(b / cells);
    inertia.value.push_back(centred.inertia);
    impulse.h.push_back(b / cells);
    impulse.value.push_back(aside.impulse);
    results.report(fmt::format("inertia_error_{}", cells), centred.inertia / added_inertia() - 1, "1");
    results.report(fmt::format("momentum_error_{}", cells), aside.impulse, "1");
    results.report(fmt::format("work_{}", cells), aside.work, "1");
  }
  const double error = std::abs(inertia.value.back() / added_inertia() - 1);
  results.expect_below("inertia_error", error, "1", context.quick() ? 0.10 : 0.03);
  results.expect_below("momentum_error", impulse.value.back(), "1", context.quick() ? 0.05 : 0.01);
  results.refinement(inertia);
  results.refinement(impulse);
}

}  // namespace seaway::validation
