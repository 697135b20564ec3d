// [mapping] Fields from one stage's mesh to the next; see README.md beside this file.
#include <cmath>
#include <cstring>

#include "core/base/constants.hpp"
#include "core/transfer/coarsen.hpp"
#include "core/transfer/map_flow.hpp"
#include "tests/unit/core/transfer/filter_law.hpp"
#include "tests/unit/core/transfer/meshes.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/mapping/wave_tank.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

using field::CellField;
using field::FaceField;
using field::offset;
using mesh::BlockShape;
using mesh::Forest;
using transfer::FlowFields;
using transfer::MapMethod;
using transfer::MapOptions;
using transfer::MapReport;
using transfer::MeshPair;
using transfer::Origin;

/// Share of the values of kept leaves, and of the faces between two of one size, that kept their
/// bits.
template <int Dim>
double kept_identical(const Forest<Dim>& from, const Forest<Dim>& to, const FlowFields<Dim>& in,
                      const FlowFields<Dim>& out) {
  const MeshPair<Dim> pair(from, to);
  double same = 0, all = 0;
  const auto compare = [&](double a, double b) {
    same += std::memcmp(&a, &b, sizeof a) == 0;
    ++all;
  };
  for (const int b : to.leaves()) {
    if (pair.source(b).origin != Origin::kept) continue;
    const int old = pair.source(b).block;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      compare(in.vof.block(old)[i], out.vof.block(b)[i]);
      compare(in.p.block(old)[i], out.p.block(b)[i]);
      for (std::size_t e = 0; e < in.extra.size(); ++e)
        compare(in.extra[e].block(old)[i], out.extra[e].block(b)[i]);
    }
    for (int axis = 0; axis < Dim; ++axis) {
      const auto kept_beyond = [&](int side) {
        const int nb =
            to.block(b).neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(axis, side))];
        if (nb == mesh::no_block) return true;
        return nb >= 0 && to.block(nb).leaf && pair.source(nb).origin == Origin::kept;
      };
      IVec<Dim> lower = field::filled<Dim>(0), upper = field::faces_upper<Dim>(axis);
      if (!kept_beyond(0)) ++lower[axis];
      if (!kept_beyond(1)) --upper[axis];
      field::for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
        const int o = offset<Dim>(i, field::face_strides<Dim>(axis));
        compare(in.u.block(axis, old)[o], out.u.block(axis, b)[o]);
        compare(in.w.block(axis, old)[o], out.w.block(axis, b)[o]);
      });
    }
  }
  return same / all;
}

/// Rms error of a smooth field over new cells, 32 coarse cells a wavelength, sides of the tank
/// included.
template <int Dim>
double smooth_error(const MapOptions& options, int threads) {
  const auto grid = transfer::testing::unit_tank<Dim>(Dim == 2 ? 2 : 4);
  const auto from = transfer::testing::boxed<Dim>(grid, 0, 0, 0, threads);
  const auto to = transfer::testing::boxed<Dim>(grid, 0, 1, 1, threads);
  const double length = grid.upper[0];
  const auto exact = [=](const Vec<Dim>& x) {
    double f = 1;
    for (int a = 0; a < Dim; ++a) f *= std::sin(2 * pi * x[a] / length + 0.3 * a + 0.2);
    return f;
  };
  FlowFields<Dim> in, out;
  transfer::testing::fill_cells<Dim>(from, exact, in.p);
  map_flow<Dim>(options, from, to, in, out);
  const double sum = to.sum_over_leaves([&](int b) {
    double s = 0;
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      s += std::pow(out.p.block(b)[offset<Dim>(i, field::cell_strides<Dim>())] -
                        exact(to.block(b).cell_centre(i)),
                    2);
    });
    return s;
  });
  return std::sqrt(sum / static_cast<double>(to.n_cells()));
}

template <int Dim>
double smooth_ratio(int degree, int radius, int threads) {
  MapOptions rbf, linear;
  rbf.degree = degree;
  rbf.radius = radius;
  linear.method = MapMethod::linear;
  return smooth_error<Dim>(rbf, threads) / smooth_error<Dim>(linear, threads);
}

struct Errors {
  double u = 0, p = 0, vof = 0;
};

/// Rms errors over refined blocks: u as part of its range, p of the wave's rho g H/2, vof over cut
/// cells.
Errors errors_at_new_points(const Forest<2>& from, const Forest<2>& to, const FlowFields<2>& exact,
                            const FlowFields<2>& found) {
  const MeshPair<2> pair(from, to);
  struct Sum {
    double squares = 0, count = 0, low = 1e300, high = -1e300;
    void add(double a, double b) {
      squares += (a - b) * (a - b);
      ++count;
      low = std::min(low, a);
      high = std::max(high, a);
    }
    double rms() const { return std::sqrt(squares / count); }
    double range() const { return high - low; }
  } u, p, vof;
  for (const int b : to.leaves()) {
    if (pair.source(b).origin != Origin::refined) continue;
    for (int i = 0; i < BlockShape<2>::cells; ++i) {
      p.add(exact.p.block(b)[i], found.p.block(b)[i]);
      const double water = exact.vof.block(b)[i];
      if (water > 0 && water < 1) vof.add(water, found.vof.block(b)[i]);
    }
    for (int axis = 0; axis < 2; ++axis)
      for (int i = 0; i < BlockShape<2>::faces; ++i)
        u.add(exact.u.block(axis, b)[i], found.u.block(axis, b)[i]);
  }
  return {u.rms() / u.range(), p.rms() / (0.5 * 9810 * wave_height), vof.rms()};
}

/// Accuracy and cost of every method on the wave tank.
void compare_methods(const Context& context, Results& results) {
  const int levels = context.quick() ? 2 : 3;
  const double base = wave_length / 64;
  const Forest<2> from = coarse_stage(base, levels, context.threads);
  const Forest<2> to = fine_stage(base, levels, context.threads);
  const FlowFields<2> in = exact_flow(from), exact = exact_flow(to);
  struct Method {
    std::string name;
    MapOptions options;
  };
  std::vector<Method> methods(5);
  methods[0].name = "rbf";
  methods[1].name = "rbf_degree2";
  methods[1].options.degree = methods[1].options.radius = 2;
  methods[1].options.limit_velocity = false;
  methods[2].name = "linear";
  methods[2].options.method = MapMethod::linear;
  methods[3].name = "prbf";
  methods[3].options.method = MapMethod::prbf;
  methods[3].options.prbf.k = 120;
  methods[4] = methods[3];
  methods[4].name = "prbf_shuffled";
  methods[4].options.prbf.ordering = transfer::Ordering::shuffle;
  results.report("cells_before", static_cast<double>(from.n_cells()), "1");
  results.report("cells_after", static_cast<double>(to.n_cells()), "1");
  for (Method& m : methods) {
    FlowFields<2> found;
    m.options.vof = transfer::VofMethod::bounded;
    const MapReport report = map_flow<2>(m.options, from, to, in, found);
    const Errors e = errors_at_new_points(from, to, exact, found);
    results.report("u_error." + m.name, e.u, "1");
    results.report("p_error." + m.name, e.p, "1");
    results.report("vof_error." + m.name, e.vof, "1");
    results.report("cpu." + m.name, report.cpu_s, "s");
  }
  FlowFields<2> split;
  map_flow<2>({}, from, to, in, split);
  results.report("vof_error.split", errors_at_new_points(from, to, exact, split).vof, "1");
}

/// A quarter of a million new cells: one volume fraction, two further cell fields, two velocities.
double time_of_large_map(int threads) {
  const auto grid = transfer::testing::unit_tank<2>(8);
  const auto from = transfer::testing::boxed<2>(grid, 0, 1, 1, threads);
  const auto to = transfer::testing::boxed<2>(grid, 0, 1, 2, threads);
  FlowFields<2> in, out;
  const auto f = [](const Vec2& x) { return std::sin(x[0]) * std::cos(x[1]); };
  transfer::testing::fill_water<2>(
      from, [](const Vec2& x) { return 4 + 0.1 * std::sin(x[0]); }, in.vof, 8);
  transfer::testing::fill_cells<2>(from, f, in.p);
  in.extra = {in.p};
  transfer::testing::fill_faces<2>(
      from, [&](const Vec2& x, int) { return f(x); }, in.u);
  in.w = in.u;
  return map_flow<2>({}, from, to, in, out).cpu_s;
}

/// Largest dt |div w| of the example just after mapping, repaired; the flow before solved so well
/// that its own divergence is not what is seen.
double divergence_of_example(int threads) {
  sim::Case c = example_case();
  c.body.release = sim::Body::Release::at_start;
  c.numerics.pressure_tolerance = 1e-11;
  const auto run = start(c, threads);
  for (int i = 0; i < 10; ++i) step(*run);
  return map_to_stage(*run, c.stages[1], threads).divergence_after;
}

}  // namespace

void run_mapping(const Context& context, Results& results) {
  const double base = wave_length / 64;
  const Forest<2> from = coarse_stage(base, 2, context.threads);
  const Forest<2> to = fine_stage(base, 2, context.threads);
  const FlowFields<2> in = exact_flow(from);
  FlowFields<2> out;
  const MapReport report = map_flow<2>({}, from, to, in, out);
  results.expect_above("kept_identical", kept_identical<2>(from, to, in, out), "1", 1);
  results.expect_below("volume_change", std::abs(report.water_after / report.water_before - 1), "1",
                       1e-12);
  results.expect_above("vof_min", report.vof_min, "1", 0);
  results.expect_below("vof_max", report.vof_max, "1", 1);
  results.expect_below(
      "smooth_error_ratio",
      std::max(smooth_ratio<2>(2, 2, context.threads), smooth_ratio<3>(2, 2, context.threads)), "1",
      0.1);
  results.report("smooth_error_ratio_default", smooth_ratio<2>(1, 1, context.threads), "1");

  results.expect_below("divergence", divergence_of_example(context.threads), "1", 1e-8);

  double worst = 0;
  for (const auto& [kernel, beta] : {std::pair{transfer::Kernel::r3, 3}, {transfer::Kernel::r, 1}})
    for (const auto& mode : transfer::testing::filter_modes(kernel, beta))
      worst = std::max(worst, std::abs(mode.amplitude - mode.law));
  results.expect_below("prbf_filter_error", worst, "1", 0.02);

  results.report("kept_cells", static_cast<double>(report.kept_cells), "1");
  results.report("new_cells", static_cast<double>(report.new_cells), "1");
  results.report("divergence_before", report.divergence_before, "1/s");
  results.report("divergence_unrepaired", report.divergence_after, "1/s");
  results.report("fall_backs", static_cast<double>(report.fall_backs), "1");
  results.report("cpu_262144_cells", time_of_large_map(context.threads), "s");
  compare_methods(context, results);
}

}  // namespace seaway::validation
