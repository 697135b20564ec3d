// [channel] Turbulent flow between immersed walls against the law of the wall; see README.md beside this file.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/field/restrict.hpp"
#include "core/flow/wall_law.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

constexpr double h = 0.01, u_tau = 0.05;

/// A channel through a tank of blocks of 16 cells: `rise` cells up in `run` cells along y, half as wide as `half`
/// cells across, its middle through the tank's.
struct Channel {
  int blocks = 2, blocks_up = 5;
  int rise = 0, along = 1;
  double half = 32.37;  // the walls lie at no fixed place in the cells
  double y_plus = 60;   // of a point half a cell from the wall
  double offset = 0.21; // of the middle line across, in cells
  flow::WallModel law = flow::WallModel::wall_function;

  int cells() const { return 16 * blocks; }
  int cells_up() const { return 16 * blocks_up; }
  Vec2 direction() const { return Vec2(along, rise).normalized(); }
  Vec2 normal() const { return {-direction()[1], direction()[0]}; }
  Vec2 middle() const { return h * Vec2(0.5 * cells(), -0.5 * cells_up()) + offset * h * normal(); }
  double height() const { return half * h; }
  double nu() const { return u_tau * 0.5 * h / y_plus; }
  /// Distance from the nearer wall.
  double distance(const Vec2& x) const { return height() - std::abs(normal().dot(x - middle())); }
};

/// A block of solid with the channel cut into it; its closed end lies outside the tank.
sim::Case case_of(const Channel& channel) {
  sim::Case c = one_fluid_tank(0, -h * channel.cells_up(), channel.cells(), channel.cells_up(), h, channel.nu());
  const double d = channel.height(), thick = 1.2 * h * (channel.cells() + channel.cells_up());
  const double reach = thick;
  const std::array<Vec2, 9> outline{Vec2(-reach, -d - thick), {reach + thick, -d - thick}, {reach + thick, d + thick},
                                    {-reach, d + thick}, {-reach, d}, {reach, d}, {reach, -d}, {-reach, -d},
                                    {-reach, -d - thick}};
  double lowest = 0;
  for (const Vec2& p : outline) {
    const Vec2 x = channel.middle() + p[0] * channel.direction() + p[1] * channel.normal();
    c.hull.vertices.push_back({x[0], x[1]});
    lowest = std::min(lowest, x[1]);
  }
  for (auto& vertex : c.hull.vertices) vertex[1] -= lowest;
  c.hull.shape = sim::Hull::Shape::polygon;
  c.body.mass = 1;
  c.body.gyradii = {1, 0, 0};
  c.body.draft = -lowest;
  c.turbulence.model = sim::Turbulence::Model::stabilised;
  c.turbulence.walls = static_cast<sim::Turbulence::Walls>(channel.law);

  c.turbulence.velocity = 1;
  c.time.dt = 1.5 * h / (25 * u_tau);
  return c;
}

double log_law(double y_plus) { return std::log(flow::wall_law::smoothness * y_plus) / flow::wall_law::kappa; }

/// Near the tank's ends the flow is that of the middle, moved along the channel by whole cells: the channel is as
/// good as endless.
template <class Field>
void recycle(const Channel& channel, const Section& run, int face_axis, double factor, Field&& block) {
  constexpr int n = mesh::BlockShape<2>::n;
  const int size = channel.cells() + (face_axis == 0), size_up = channel.cells_up() + (face_axis == 1);
  const auto at = [&](int i, int j) -> double& {
    const IVec<2> coord{std::min(i / n, channel.blocks - 1), std::min(j / n, channel.blocks_up - 1)};
    const IVec<2> inside{i - coord[0] * n, j - coord[1] * n};
    const IVec<2> strides = face_axis < 0 ? field::cell_strides<2>() : field::face_strides<2>(face_axis);
    return block(run.forest().find(0, coord))[field::offset<2>(inside, strides)];
  };
  const int first = channel.cells() / 2 - 2;
  for (int i = 0; i < size; ++i) {
    if (i >= 8 && i < channel.cells() - 7) continue;
    // Whole moves by (along, rise) to the columns `first` .. first + along - 1.
    const int moves = static_cast<int>(std::floor(static_cast<double>(first - i) / channel.along)) + (i > first ? 1 : 0);
    for (int j = 0; j < size_up; ++j) {
      const int k = j + moves * channel.rise;
      if (k >= 0 && k < size_up) at(i, j) = factor * at(i + moves * channel.along, k);
    }
  }
}

/// dp/ds less the weight, from the cells across the channel half way between its middle and the recycled ends.
double pressure_gradient(const Channel& channel, const Section& run) {
  double count = 0, s1 = 0, p1 = 0, ss = 0, sp = 0;
  const double reach = 0.25 * h * channel.cells();
  each_cell(run, [&](int b, int i, const Vec2& x) {
    const double s = channel.direction().dot(x - channel.middle());
    if (channel.distance(x) < 3 * h || std::abs(s) > reach) return;
    const double p = run.state().p.block(b)[i] + run.model().fluids.rho_water * run.model().fluids.gravity * x[1];
    count += 1;
    s1 += s;
    p1 += p;
    ss += s * s;
    sp += s * p;
  });
  return (count * sp - s1 * p1) / (count * ss - s1 * s1);  // least squares
}

struct Flow {
  double error = 0;           ///< largest deviation from the law: y+ >= 30, from a cell to 0.2 of the half width
  double first_error = 0;     ///< the same from half a cell to a cell
  double balance = 0;         ///< pressure gradient times half width over the walls' stress, less 1
  double drift = 0;           ///< change of the velocity in the middle in the last quarter, relative
};

Flow develop(const Channel& channel, double turnovers, int threads) {
  const sim::Case c = case_of(channel);
  const auto run = start(c, threads);
  const Vec2 direction = channel.direction();
  const double height = channel.height(), nu = channel.nu();
  const auto law = [&](const Vec2& x) {
    const double y = std::max(channel.distance(x), 0.5 * h);
    return u_tau * log_law(u_tau * y / nu);
  };
  set_velocity(*run, [&](const Vec2& x, int axis) { return law(x) * direction[axis]; });
  auto& state = run->state();
  each_cell(*run, [&](int b, int i, const Vec2& x) {
    const double y = std::max(channel.distance(x), 0.5 * h);
    const double k = u_tau * u_tau / std::sqrt(flow::k_epsilon::c_mu) * std::max(0.3, 1 - y / height);
    state.tke.block(b)[i] = k;
    state.epsilon.block(b)[i] = std::pow(flow::k_epsilon::c_mu, 0.75) * std::pow(k, 1.5) / (flow::wall_law::kappa * y);
  });
  const double duration = turnovers * height / u_tau;
  const auto speed = [&](const Vec2& x) {
    return direction[0] * velocity_at(*run, 0, x) + direction[1] * velocity_at(*run, 1, x);
  };
  // Flux across the middle, held at its first value: what drives the flow is the pressure gradient that this needs.
  const auto flux = [&] {
    double sum = 0;
    for (double n = -height + 0.125 * h; n < height; n += 0.25 * h) sum += 0.25 * h * speed(channel.middle() + n * channel.normal());
    return sum;
  };
  const double wanted = flux();
  double earlier = 0;
  Record gradient;
  while (run->time() < duration) {
    const double factor = wanted / flux();
    for (int axis = 0; axis < 2; ++axis) {
      recycle(channel, *run, axis, factor, [&](int b) { return state.u.block(axis, b); });
      field::restrict_faces<double, 2>(run->forest(), state.u, axis);
    }
    recycle(channel, *run, -1, 1.0, [&](int b) { return state.tke.block(b); });
    recycle(channel, *run, -1, 1.0, [&](int b) { return state.epsilon.block(b); });
    step(*run);
    if (run->time() < 0.75 * duration) earlier = speed(channel.middle());
    else gradient.add(run->time(), pressure_gradient(channel, *run));
  }
  Flow out;
  out.drift = std::abs(speed(channel.middle()) / earlier - 1);
  // The walls' own stress: what the law of the wall gives at its image points, 1.5 cells out.
  double sum = 0;
  int count = 0;
  const auto for_places = [&](auto&& f) {  // lines across the middle of the channel, on both sides
    for (int place = -8; place <= 8; ++place)
      for (const double side : {-1.0, 1.0})
        f([&, place, side](double y) {
          return speed(channel.middle() + 0.5 * place * h * direction + side * (height - y) * channel.normal());
        });
  };
  const double image = 1.5 * h * (direction[0] + direction[1]);
  for_places([&](auto&& at) {
    sum += flow::wall_law::friction_velocity(at(image), image, nu);
    ++count;
  });
  const double friction_velocity = sum / count;
  double mean = 0;
  for (const double g : gradient.value) mean -= g / static_cast<double>(gradient.value.size());
  out.balance = mean * height / (c.fluids.rho_water * friction_velocity * friction_velocity) - 1;
  for_places([&](auto&& at) {
    for (double y = 0.5 * h; y <= 0.2 * height; y += 0.25 * h) {
      if (friction_velocity * y / nu < 30) continue;
      const double error = std::abs(at(y) / (friction_velocity * log_law(friction_velocity * y / nu)) - 1);
      if (y < h) out.first_error = std::max(out.first_error, error);
      else out.error = std::max(out.error, error);
    }
  });
  return out;
}

struct Laminar {
  double error = 0;    ///< largest deviation from the parabola, over the speed in the middle
  double balance = 0;  ///< pressure gradient over that of the exact solution, less 1
};

/// Plane Poiseuille flow at Re 100 (half width, speed in the middle) between no-slip walls.
Laminar laminar_flow(const Channel& channel, double duration, int threads) {
  sim::Case c = case_of(channel);
  const double height = channel.height(), middle_speed = 1, nu = middle_speed * height / 100;
  c.fluids.nu_air = c.fluids.nu_water = nu;
  c.turbulence = {};
  c.turbulence.model = sim::Turbulence::Model::laminar;
  c.turbulence.walls = sim::Turbulence::Walls::no_slip;
  c.time.dt = 1.2 * h / middle_speed;
  const auto run = start(c, threads);
  const Vec2 direction = channel.direction();
  const auto exact = [&](double from_wall) {
    const double n = 1 - from_wall / height;
    return middle_speed * std::max(0.0, 1 - n * n);
  };
  set_velocity(*run, [&](const Vec2& x, int axis) { return exact(channel.distance(x)) * direction[axis]; });
  const auto speed = [&](const Vec2& x) {
    return direction[0] * velocity_at(*run, 0, x) + direction[1] * velocity_at(*run, 1, x);
  };
  const auto flux = [&] {
    double sum = 0;
    for (double n = -height + 0.125 * h; n < height; n += 0.25 * h)
      sum += 0.25 * h * speed(channel.middle() + n * channel.normal());
    return sum;
  };
  const double wanted = 4.0 / 3 * middle_speed * height;
  Record gradient;
  while (run->time() < duration * height / middle_speed) {
    const double factor = wanted / flux();
    for (int axis = 0; axis < 2; ++axis) {
      recycle(channel, *run, axis, factor, [&](int b) { return run->state().u.block(axis, b); });
      field::restrict_faces<double, 2>(run->forest(), run->state().u, axis);
    }
    step(*run);
    if (run->time() > 0.75 * duration * height / middle_speed) gradient.add(run->time(), pressure_gradient(channel, *run));
  }
  Laminar out;
  double mean = 0;
  for (const double g : gradient.value) mean -= g / static_cast<double>(gradient.value.size());
  out.balance = mean / (2 * c.fluids.rho_water * nu * middle_speed / (height * height)) - 1;
  for (const double side : {-1.0, 1.0})
    for (double y = h; y < height; y += 0.25 * h) {
      const double u = speed(channel.middle() + side * (height - y) * channel.normal());
      out.error = std::max(out.error, std::abs(u - exact(y)) / middle_speed);
    }
  return out;
}

/// What a uniform flow between slip walls loses without viscosity: pressure gradient times half width over rho U^2.
double slip_loss(const Channel& channel, int threads) {
  sim::Case c = case_of(channel);
  c.fluids.viscous = false;
  c.turbulence = {};
  c.time.dt = 0.5 * h;
  const auto run = start(c, threads);
  set_velocity(*run, [&](const Vec2&, int axis) { return channel.direction()[axis]; });
  double sum = 0;
  constexpr int steps = 60, counted = 20;
  for (int i = 0; i < steps; ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      recycle(channel, *run, axis, 1.0, [&](int b) { return run->state().u.block(axis, b); });
      field::restrict_faces<double, 2>(run->forest(), run->state().u, axis);
    }
    step(*run);
    if (i >= steps - counted) sum -= pressure_gradient(channel, *run) / counted;
  }
  return sum * channel.height() / c.fluids.rho_water;
}

/// No-slip walls, resolved: half widths of 8, 16 (and 32) cells.
void run_laminar(const Context& context, Results& results) {
  std::vector<Laminar> flows;
  for (const int rows : context.quick() ? std::vector<int>{8, 16} : std::vector<int>{8, 16, 32}) {
    Channel channel;
    channel.half = rows + 0.37;
    channel.blocks_up = rows / 8 + 1;
    flows.push_back(laminar_flow(channel, 20, context.threads));
    results.report(fmt::format("laminar_error_{}", rows), flows.back().error, "1");
    results.report(fmt::format("laminar_balance_{}", rows), flows.back().balance, "1");
  }
  const std::size_t last = flows.size() - 1;
  Refinement meshes{"laminar_error", "1", {}, {}, 1, 0.0};
  for (std::size_t i = 0; i < flows.size(); ++i) {
    meshes.h.push_back(1 / (8.0 * (1 << i) + 0.37));  // of half the width
    meshes.value.push_back(flows[i].error);
  }
  results.refinement(meshes);
  // First order: the outermost row of cells counts as a whole one.
  results.expect_above("laminar_order", std::log2(flows[last - 1].error / flows[last].error), "1", 0.9);
  results.expect_below("laminar_error", flows[last].error, "1", context.quick() ? 0.01 : 0.005);
}

}  // namespace

void run_channel(const Context& context, Results& results) {
  run_laminar(context, results);
  Channel aligned;
  if (context.quick()) {  // half as wide
    aligned.blocks_up = 3;
    aligned.half = 16.37;
  }
  const Flow first = develop(aligned, 1, context.threads);
  double error = first.error, first_error = first.first_error;
  if (!context.quick()) {
    for (const double y_plus : {30.0, 120.0, 200.0}) {
      Channel channel = aligned;
      channel.y_plus = y_plus;
      const Flow flow = develop(channel, 1, context.threads);
      results.report(fmt::format("log_law_error_{:.0f}", y_plus), flow.error, "1");
      error = std::max(error, flow.error);
      first_error = std::max(first_error, flow.first_error);
    }
  }
  results.expect_below("log_law_error", error, "1", 0.03);  // bar of the project
  results.report("first_cell_error", first_error, "1");
  results.report("momentum_balance", first.balance, "1");
  results.report("drift", first.drift, "1");
  Channel oblique;
  oblique.blocks = oblique.blocks_up = 4;
  oblique.rise = 1;
  oblique.along = 2;
  oblique.half = 11.6;
  // What is left is the residual of the pressure solve; without the slip flux it would be 0.012.
  results.expect_below("slip_loss_oblique", std::abs(slip_loss(oblique, context.threads)), "1", 1e-4);
  if (context.quick()) return;
  Channel sensitised = aligned;
  sensitised.law = flow::WallModel::non_equilibrium;
  results.report("log_law_error_non_equilibrium", develop(sensitised, 1, context.threads).error, "1");
  const Flow second = develop(oblique, 1.5, context.threads);
  results.expect_below("log_law_error_oblique", second.error, "1", 0.03);
  results.report("momentum_balance_oblique", second.balance, "1");
  results.report("slip_loss_aligned", slip_loss(aligned, context.threads), "1");
}

}  // namespace seaway::validation
