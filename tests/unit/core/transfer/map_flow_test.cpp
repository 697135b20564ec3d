#include "core/transfer/map_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "tests/unit/core/transfer/meshes.hpp"

namespace seaway::transfer {
namespace {

using namespace testing;

template <int Dim>
double smooth(const Vec<Dim>& x, double length) {
  double f = 1;
  for (int a = 0; a < Dim; ++a) f *= std::sin(2 * pi * std::fmod(x[a], length) / length + 0.3 * a + 0.2);
  return f;
}

/// A flow with a wave and a solenoidal w, made discretely so from a vector potential on the fine grid.
template <int Dim>
FlowFields<Dim> make_flow(const Forest<Dim>& forest) {
  const double length = forest.grid().upper[0];
  FlowFields<Dim> f;
  fill_water<Dim>(forest, [=](const Vec<Dim>& x) {
    return 0.51 * length + 0.03 * length * std::cos(2 * pi * x[0] / length);
  }, f.vof, 8);
  fill_cells<Dim>(forest, [=](const Vec<Dim>& x) { return smooth<Dim>(x, length); }, f.p);
  f.extra.resize(2);
  fill_cells<Dim>(forest, [=](const Vec<Dim>& x) { return std::exp(-3 * x[Dim - 1]); }, f.extra[0]);
  fill_cells<Dim>(forest, [=](const Vec<Dim>& x) { return 2 * x[0] - x[Dim - 1]; }, f.extra[1]);
  fill_faces<Dim>(forest, [=](const Vec<Dim>& x, int axis) { return smooth<Dim>(x, length) + axis; }, f.u);
  // w = curl of psi(x, z) in the plane of the first and last axis, as differences along each face.
  f.w = FaceField<double, Dim>(forest);
  const auto psi = [=](double x, double z) {
    return std::sin(pi * x / length) * std::sin(pi * x / length) * std::sin(pi * z / length);
  };
  for (const int b : forest.leaves()) {
    const Vec<Dim> h = forest.block(b).h;
    for (const int axis : {0, Dim - 1})
      field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        const Vec<Dim> x = forest.block(b).face_centre(i, axis);
        const int across = axis == 0 ? Dim - 1 : 0;
        Vec<Dim> low = x, high = x;
        low[across] -= 0.5 * h[across];
        high[across] += 0.5 * h[across];
        const double difference = (psi(high[0], high[Dim - 1]) - psi(low[0], low[Dim - 1])) / h[across];
        f.w.block(axis, b)[field::offset<Dim>(i, field::face_strides<Dim>(axis))] =
            axis == 0 ? difference : -difference;
      });
  }
  return f;
}

template <int Dim>
bool same_bits(const double* a, const double* b) {
  return std::memcmp(a, b, BlockShape<Dim>::cells * sizeof(double)) == 0;
}

/// Largest change of the flux through an old face, taken from the new faces on it; where the new mesh is
/// coarser there are none.
template <int Dim>
double flux_error(const Forest<Dim>& from, const Forest<Dim>& to, const FlowFields<Dim>& in,
                  const FlowFields<Dim>& out) {
  FlowFields<Dim> back;
  map_flow<Dim>({}, to, from, out, back);  // means of the fine faces
  const MeshPair<Dim> pair(to, from);
  double error = 0;
  for (const int b : from.leaves()) {
    if (pair.source(b).origin == Origin::refined) continue;
    for (int axis = 0; axis < Dim; ++axis)
      for (int i = 0; i < BlockShape<Dim>::faces; ++i)
        error = std::max(error, std::abs(back.w.block(axis, b)[i] - in.w.block(axis, b)[i]));
  }
  return error;
}

template <int Dim>
void check_refinement(MapMethod method) {
  const auto grid = unit_tank<Dim>(4);
  const Forest<Dim> from = boxed<Dim>(grid, 0, 0.7, 1), to = boxed<Dim>(grid, 0.8, 0.95, Dim == 2 ? 3 : 2);
  FlowFields<Dim> in = make_flow(from), out;
  // The coarse faces at level jumps get the means of the fine ones, as the solver keeps them.
  {
    FlowFields<Dim> consistent;
    map_flow<Dim>({}, from, from, in, consistent);
    in = consistent;
  }
  MapOptions options;
  options.method = method;
  const MapReport report = map_flow<Dim>(options, from, to, in, out);
  const MeshPair<Dim> pair(from, to);
  EXPECT_EQ(report.kept_cells + report.new_cells, to.n_cells());
  EXPECT_EQ(report.kept_cells, pair.cells(Origin::kept));
  EXPECT_GT(report.kept_cells, 0);
  EXPECT_GT(report.coarsened_cells, 0);
  for (const int b : to.leaves()) {
    const BlockSource& s = pair.source(b);
    EXPECT_EQ(report.origin[static_cast<std::size_t>(b) * BlockShape<Dim>::cells],
              static_cast<char>(s.origin));
    if (s.origin != Origin::kept) continue;
    EXPECT_TRUE(same_bits<Dim>(in.vof.block(s.block), out.vof.block(b)));
    EXPECT_TRUE(same_bits<Dim>(in.p.block(s.block), out.p.block(b)));
    EXPECT_TRUE(same_bits<Dim>(in.extra[0].block(s.block), out.extra[0].block(b)));
    for (int axis = 0; axis < Dim; ++axis)
      field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        const int o = field::offset<Dim>(i, field::face_strides<Dim>(axis));
        const double change = out.u.block(axis, b)[o] - in.u.block(axis, s.block)[o];
        const bool inner = i[axis] > 0 && i[axis] < BlockShape<Dim>::n;
        if (inner) EXPECT_EQ(change, 0);
        else EXPECT_NEAR(change, 0, 1e-15);  // sums over parts of a face are rounded
      });
  }
  EXPECT_GE(report.vof_min, 0);
  EXPECT_LE(report.vof_max, 1);
  EXPECT_NEAR(report.water_after / report.water_before, 1, 1e-13);
  for (std::size_t e = 0; e < 2; ++e)
    EXPECT_NEAR(volume_integral(to, out.extra[e]) / volume_integral(from, in.extra[e]), 1, 1e-12);
  EXPECT_LT(flux_error(from, to, in, out), 1e-14);
  EXPECT_LT(report.divergence_before, 1e-12);
}
TEST(MapFlow, KeepsCopiesConservesAndBoundsIn2D) { check_refinement<2>(MapMethod::local_rbf); }
TEST(MapFlow, KeepsCopiesConservesAndBoundsIn3D) { check_refinement<3>(MapMethod::local_rbf); }
TEST(MapFlow, LinearKeepsTheSamePromisesIn2D) { check_refinement<2>(MapMethod::linear); }
TEST(MapFlow, LinearKeepsTheSamePromisesIn3D) { check_refinement<3>(MapMethod::linear); }

template <int Dim>
void check_shared_faces() {
  const auto grid = unit_tank<Dim>(4, true);
  const Forest<Dim> from = boxed<Dim>(grid, 0.2, 0.7, 1), to = boxed<Dim>(grid, 0.0, 0.3, Dim == 2 ? 3 : 2);
  FlowFields<Dim> out;
  map_flow<Dim>({}, from, to, make_flow(from), out);
  for (const int b : to.leaves())
    for (int axis = 0; axis < Dim; ++axis) {
      const int nb = to.block(b).neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(axis, 0))];
      if (nb < 0 || !to.block(nb).leaf) continue;
      IVec<Dim> upper = field::cells_upper<Dim>();
      upper[axis] = 1;
      field::for_box<Dim>(field::filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
        IVec<Dim> j = i;
        j[axis] = BlockShape<Dim>::n;
        const auto strides = field::face_strides<Dim>(axis);
        EXPECT_EQ(out.u.block(axis, b)[field::offset<Dim>(i, strides)],
                  out.u.block(axis, nb)[field::offset<Dim>(j, strides)]);
      });
    }
}
TEST(MapFlow, BlocksAgreeOnSharedFacesIn2D) { check_shared_faces<2>(); }
TEST(MapFlow, BlocksAgreeOnSharedFacesIn3D) { check_shared_faces<3>(); }

template <int Dim>
void check_linear_fields() {
  const auto grid = unit_tank<Dim>(2);
  const Forest<Dim> from = boxed<Dim>(grid, 0, 0, 0), to = boxed<Dim>(grid, 0, 1, 2);
  const Function<Dim> f = [](const Vec<Dim>& x) { return 1 + x.sum() - 3 * x[Dim - 1]; };
  FlowFields<Dim> in, out;
  fill_cells<Dim>(from, f, in.p);
  fill_faces<Dim>(from, [&](const Vec<Dim>& x, int axis) { return f(x) * (axis + 1); }, in.u);
  MapOptions options;
  options.limit_velocity = false;
  map_flow<Dim>(options, from, to, in, out);
  for (const int b : to.leaves()) {
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      EXPECT_NEAR(out.p.block(b)[field::offset<Dim>(i, field::cell_strides<Dim>())],
                  f(to.block(b).cell_centre(i)), 1e-12);
    });
    for (int axis = 0; axis < Dim; ++axis)
      field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        EXPECT_NEAR(out.u.block(axis, b)[field::offset<Dim>(i, field::face_strides<Dim>(axis))],
                    f(to.block(b).face_centre(i, axis)) * (axis + 1), 1e-12);
      });
  }
}
TEST(MapFlow, LinearFieldsAreExactUpToTheWallsIn2D) { check_linear_fields<2>(); }
TEST(MapFlow, LinearFieldsAreExactUpToTheWallsIn3D) { check_linear_fields<3>(); }

/// Rms error of a smooth field over the children, 32 coarse cells a wavelength; walls included.
template <int Dim>
double smooth_error(const MapOptions& options) {
  const auto grid = unit_tank<Dim>(Dim == 2 ? 2 : 4);
  const Forest<Dim> from = boxed<Dim>(grid, 0, 0, 0), to = boxed<Dim>(grid, 0, 1, 1);
  const double length = grid.upper[0];
  const Function<Dim> f = [=](const Vec<Dim>& x) { return smooth<Dim>(x, length); };
  FlowFields<Dim> in, out;
  fill_cells<Dim>(from, f, in.p);
  map_flow<Dim>(options, from, to, in, out);
  double sum = 0;
  for (const int b : to.leaves())
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      sum += std::pow(out.p.block(b)[field::offset<Dim>(i, field::cell_strides<Dim>())] -
                      f(to.block(b).cell_centre(i)), 2);
    });
  return std::sqrt(sum / static_cast<double>(to.n_cells()));
}
template <int Dim>
void check_smooth() {
  MapOptions linear, rbf;
  linear.method = MapMethod::linear;
  rbf.degree = 2;
  rbf.radius = 2;
  EXPECT_LT(smooth_error<Dim>(rbf), 0.1 * smooth_error<Dim>(linear));
}
TEST(MapFlow, SmoothFieldsAreTenTimesBetterThanLinearIn2D) { check_smooth<2>(); }
TEST(MapFlow, SmoothFieldsAreTenTimesBetterThanLinearIn3D) { check_smooth<3>(); }

template <int Dim>
void check_threads() {
  const auto grid = unit_tank<Dim>(4);
  FlowFields<Dim> first;
  for (const int threads : {1, 2, 4}) {
    const Forest<Dim> from = boxed<Dim>(grid, 0.2, 0.7, 1, threads);
    const Forest<Dim> to = boxed<Dim>(grid, 0.8, 0.95, Dim == 2 ? 3 : 2, threads);
    FlowFields<Dim> out;
    map_flow<Dim>({}, from, to, make_flow(from), out);
    if (threads == 1) first = out;
    EXPECT_EQ(first.vof.data(), out.vof.data());
    EXPECT_EQ(first.p.data(), out.p.data());
    for (int axis = 0; axis < Dim; ++axis) EXPECT_EQ(first.u.data(axis), out.u.data(axis));
  }
}
TEST(MapFlow, ThreadsChangeNoBitIn2D) { check_threads<2>(); }
TEST(MapFlow, ThreadsChangeNoBitIn3D) { check_threads<3>(); }

TEST(MapFlow, BoundedFractionsStayBoundedAndConserved) {
  const auto grid = unit_tank<2>(4);
  const Forest<2> from = boxed<2>(grid, 0.2, 0.7, 1), to = boxed<2>(grid, 0.1, 0.9, 2);
  FlowFields<2> out;
  MapOptions options;
  options.vof = VofMethod::bounded;
  const MapReport report = map_flow<2>(options, from, to, make_flow(from), out);
  EXPECT_GE(report.vof_min, 0);
  EXPECT_LE(report.vof_max, 1);
  EXPECT_NEAR(report.water_after / report.water_before, 1, 1e-13);
}

TEST(MapFlow, MapsAQuarterMillionCellsFast) {
  const auto grid = unit_tank<2>(8);
  const Forest<2> from = boxed<2>(grid, 0, 1, 1), to = boxed<2>(grid, 0, 1, 2);
  FlowFields<2> in = make_flow(from), out;
  const MapReport report = map_flow<2>({}, from, to, in, out);
  EXPECT_EQ(report.new_cells, 262144);
  EXPECT_LT(report.cpu_s, 5.0);  // 0.1 s on one 2.5 GHz core; the rest is room for sanitizers
}

template <int Dim>
void check_prbf(bool all) {
  const auto grid = unit_tank<Dim>(2);
  const Forest<Dim> from = boxed<Dim>(grid, 0, 0.4, 1), to = boxed<Dim>(grid, 0.6, 0.9, 1);
  FlowFields<Dim> in, local, out;
  map_flow<Dim>({}, from, from, make_flow(from), in);
  MapOptions options;
  options.method = MapMethod::prbf;
  options.prbf.k = 8;
  options.prbf.ordering = Ordering::morton;
  options.prbf.evaluate_all = all;
  const MapReport report = map_flow<Dim>(options, from, to, in, out);
  map_flow<Dim>({}, from, to, in, local);
  EXPECT_EQ(report.method, "prbf");
  EXPECT_EQ(report.kept_cells > 0, !all);
  EXPECT_NEAR(report.water_after / report.water_before, 1, 1e-13);
  const MeshPair<Dim> pair(from, to);
  double difference = 0, worst = 0, size = 0;
  for (const int b : to.leaves()) {
    if (!all && pair.source(b).origin == Origin::kept) {
      EXPECT_TRUE(same_bits<Dim>(out.p.block(b), in.p.block(pair.source(b).block)));
    }
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      difference += std::pow(out.p.block(b)[i] - local.p.block(b)[i], 2);
      size += std::pow(local.p.block(b)[i], 2);
      worst = std::max(worst, std::abs(out.extra[1].block(b)[i] - local.extra[1].block(b)[i]));
    }
  }
  EXPECT_GT(difference, 0);                       // another method
  EXPECT_LT(std::sqrt(difference / size), 0.08);  // of the same field (16 cells a wavelength in 3-D)
  EXPECT_LT(worst, 0.05);                         // linear but for the limiter of the local one
  // What crosses the tank's sides is not touched, nor is what crosses into kept cells.
  double net = 0;
  for (const int b : to.leaves())
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side) {
        if (to.block(b).neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(axis, side))] !=
            mesh::no_block) continue;
        IVec<Dim> lower = field::filled<Dim>(0), upper = field::cells_upper<Dim>();
        lower[axis] = side * BlockShape<Dim>::n;
        upper[axis] = lower[axis] + 1;
        field::for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
          const int o = field::offset<Dim>(i, field::face_strides<Dim>(axis));
          net = std::max(net, std::abs(out.w.block(axis, b)[o] - local.w.block(axis, b)[o]));
        });
      }
  EXPECT_LT(net, 1e-14);
}
TEST(MapFlow, PrbfReplacesAllValuesIn2D) { check_prbf<2>(true); }
TEST(MapFlow, PrbfReplacesAllValuesIn3D) { check_prbf<3>(true); }
TEST(MapFlow, PrbfAtNewPointsKeepsTheOthersIn2D) { check_prbf<2>(false); }
TEST(MapFlow, PrbfAtNewPointsKeepsTheOthersIn3D) { check_prbf<3>(false); }

TEST(MapFlow, RefusesOptionsOutOfRange) {
  const Forest<2> mesh = boxed<2>(unit_tank<2>(1), 0, 0, 0);
  FlowFields<2> out;
  MapOptions options;
  options.degree = 3;
  EXPECT_THROW(map_flow<2>(options, mesh, mesh, {}, out), Error);
}

}  // namespace
}  // namespace seaway::transfer
