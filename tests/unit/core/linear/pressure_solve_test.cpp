// The pressure operator and its preconditioner on a mesh with level jumps and a density jump of 833.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "core/linear/conjugate_gradient.hpp"
#include "core/mesh/refinement.hpp"

namespace seaway::linear {
namespace {

template <int Dim>
struct Problem {
  std::unique_ptr<Forest<Dim>> forest;
  std::unique_ptr<PoissonOperator<Dim>> op;
  std::unique_ptr<Multigrid<Dim>> multigrid;

  explicit Problem(int levels, int threads = 1, bool open_top = true, int roots = 2) {
    mesh::TankGrid<Dim> grid;
    for (int a = 0; a < Dim; ++a) {
      grid.lower[a] = -1;
      grid.upper[a] = 1;
      grid.root_blocks[a] = roots;
    }
    std::vector<mesh::RefinedBox<Dim>> boxes;
    const double base = 2.0 / (roots * BlockShape<Dim>::n);
    for (int l = 1; l < levels; ++l) {
      mesh::RefinedBox<Dim> box;
      box.lower = Vec<Dim>::Constant(-0.5 / l);
      box.upper = Vec<Dim>::Constant(0.3 / l);
      box.cell = base / (1 << l);
      boxes.push_back(box);
    }
    forest = std::make_unique<Forest<Dim>>(grid, levels - 1, mesh::refine_boxes(grid, boxes), threads);
    op = std::make_unique<PoissonOperator<Dim>>(*forest);
    multigrid = std::make_unique<Multigrid<Dim>>(*op);
    const auto density = [](const Vec<Dim>& x) {
      return x[Dim - 1] < 0.03 + 0.05 * std::sin(4 * x[0]) ? 1000.0 : 1.2;
    };
    for (const int b : forest->leaves()) {
      const auto& block = forest->block(b);
      for (int axis = 0; axis < Dim; ++axis) {
        float* c = op->coefficients().block(axis, b);
        field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
          double distance = block.h[axis];
          const int side = i[axis] == 0 ? 0 : (i[axis] == BlockShape<Dim>::n ? 1 : -1);
          double open = 1;
          if (side >= 0) {
            const int nb = block.neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(axis, side))];
            if (nb == mesh::coarser_neighbour) distance *= 1.5;
            if (nb == mesh::no_block) {
              distance *= 0.5;
              open = open_top && axis == Dim - 1 && side == 1 ? 1 : 0;
            }
          }
          Vec<Dim> x = block.face_centre(i, axis), lo = x, hi = x;
          lo[axis] -= 0.5 * block.h[axis];
          hi[axis] += 0.5 * block.h[axis];
          const double area = block.cell_volume() / block.h[axis];
          c[field::offset<Dim>(i, field::face_strides<Dim>(axis))] =
              static_cast<float>(open * area / (0.5 * (density(lo) + density(hi)) * distance));
        });
      }
    }
    op->finish();
    multigrid->update();
  }
  CellField<double, Dim> random_field(unsigned seed) const {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    CellField<double, Dim> f(*forest);
    for (const int b : forest->leaves())
      for (int i = 0; i < BlockShape<Dim>::cells; ++i) f.block(b)[i] = uniform(rng);
    return f;
  }
  double dot(const CellField<double, Dim>& x, const CellField<double, Dim>& y) const {
    return forest->sum_over_leaves([&](int b) {
      double s = 0;
      for (int i = 0; i < BlockShape<Dim>::cells; ++i) s += x.block(b)[i] * y.block(b)[i];
      return s;
    });
  }
  CellField<double, Dim> precondition(const CellField<double, Dim>& r) {
    multigrid->apply(r);
    CellField<double, Dim> z(*forest);
    for (const int b : forest->leaves())
      for (int i = 0; i < BlockShape<Dim>::cells; ++i)
        z.block(b)[i] = multigrid->scale() * static_cast<double>(multigrid->solution(b)[i]);
    return z;
  }
};

template <int Dim>
void check_operator_symmetry() {
  Problem<Dim> problem(3);
  const auto x = problem.random_field(1), y = problem.random_field(2);
  CellField<double, Dim> ax(*problem.forest), ay(*problem.forest);
  const double xax = problem.op->apply(x, ax);
  (void)problem.op->apply(y, ay);
  const double scale = std::sqrt(problem.dot(ax, ax) * problem.dot(y, y));
  EXPECT_NEAR(problem.dot(ax, y), problem.dot(x, ay), 1e-13 * scale);
  EXPECT_NEAR(xax, problem.dot(x, ax), 1e-12 * std::abs(xax));
}
TEST(PoissonOperator, IsSymmetricAcrossLevelJumpsIn2D) { check_operator_symmetry<2>(); }
TEST(PoissonOperator, IsSymmetricAcrossLevelJumpsIn3D) { check_operator_symmetry<3>(); }

TEST(PoissonOperator, ConstantsAreItsNullSpaceBetweenWalls) {
  Problem<2> problem(3, 1, false);
  CellField<double, 2> one(*problem.forest, 1.0), out(*problem.forest);
  (void)problem.op->apply(one, out);
  double largest = 0, scale = 0;
  for (const int b : problem.forest->leaves())
    for (int i = 0; i < BlockShape<2>::cells; ++i) {
      largest = std::max(largest, std::abs(out.block(b)[i]));
      scale = std::max(scale, 1.0 / static_cast<double>(problem.op->inverse_diagonal().block(b)[i]));
    }
  EXPECT_LT(largest, 1e-14 * scale);
}

template <int Dim>
void check_cycle_symmetry() {
  Problem<Dim> problem(3);
  const auto x = problem.random_field(1), y = problem.random_field(2);
  const auto mx = problem.precondition(x), my = problem.precondition(y);
  const double scale = std::sqrt(problem.dot(mx, mx) * problem.dot(y, y));
  EXPECT_NEAR(problem.dot(mx, y), problem.dot(x, my), 1e-5 * scale);
  EXPECT_GT(problem.dot(mx, x), 0);
}
TEST(Multigrid, CycleIsSymmetricAndPositiveIn2D) { check_cycle_symmetry<2>(); }
TEST(Multigrid, CycleIsSymmetricAndPositiveIn3D) { check_cycle_symmetry<3>(); }

template <int Dim>
int iterations(int levels, int roots = 2) {
  Problem<Dim> problem(levels, 1, true, roots);
  ConjugateGradient<Dim> cg(*problem.forest);
  CellField<double, Dim> x(*problem.forest);
  auto b = problem.random_field(3);
  for (const int blk : problem.forest->leaves())
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) b.block(blk)[i] *= problem.forest->block(blk).cell_volume();
  const auto report = cg.solve(*problem.op, *problem.multigrid, b, x, 1e-6, 100);
  EXPECT_TRUE(report.converged);
  std::cout << Dim << "-D, " << levels << " levels, " << problem.forest->n_cells() << " cells: " << report.iterations
            << " iterations\n";
  return report.iterations;
}
TEST(Multigrid, IterationsDoNotGrowWithResolution) {
  // Random right-hand side over six decades, the density jump crossing every level jump.
  const int coarse = iterations<2>(3), fine = iterations<2>(6);
  EXPECT_LE(coarse, 12);
  EXPECT_LE(fine, coarse + 1);  // 2 more without the rounds in blocks where water meets air
  EXPECT_LE(iterations<3>(3), 13);
}
TEST(Multigrid, IterationsDoNotGrowWithTheRootGrid) { EXPECT_LE(iterations<2>(3, 8), iterations<2>(3, 2) + 2); }

/// Shuts the faces of thin walls: a box of 0.25 x 0.5 with walls of two cells, open to the outside at one place.
template <int Dim>
void build_box(Problem<Dim>& problem, double wall) {
  const double lower[2] = {-0.25, -0.35}, upper[2] = {0.0, 0.15};
  for (const int b : problem.forest->leaves()) {
    const auto& block = problem.forest->block(b);
    for (int axis = 0; axis < Dim; ++axis) {
      float* c = problem.op->coefficients().block(axis, b);
      field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        const Vec<Dim> x = block.face_centre(i, axis);
        double inside = 1e9;  // distance to the box's surface, > 0 inside
        for (int a = 0; a < Dim; ++a) {
          const int k = a == Dim - 1 ? 1 : 0;
          inside = std::min({inside, x[a] - lower[k], upper[k] - x[a]});
        }
        const bool opening = x[0] > -0.05 && std::abs(x[Dim - 1] + 0.2) < 0.03;
        if (std::abs(inside) < 0.5 * wall && !opening) c[field::offset<Dim>(i, field::face_strides<Dim>(axis))] = 0;
      });
    }
  }
  problem.op->finish();
  problem.multigrid->update();
}

template <int Dim>
int iterations_with_a_box(int levels, double wall) {
  Problem<Dim> problem(levels);
  build_box<Dim>(problem, wall);
  const auto field = [&](unsigned seed, bool of_volume) {  // nothing in closed cells
    auto f = problem.random_field(seed);
    for (const int blk : problem.forest->leaves())
      for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
        const bool open = problem.op->inverse_diagonal().block(blk)[i] > 0;
        f.block(blk)[i] *= open ? (of_volume ? problem.forest->block(blk).cell_volume() : 1.0) : 0.0;
      }
    return f;
  };
  const auto x = field(1, false), y = field(2, false);
  const auto mx = problem.precondition(x), my = problem.precondition(y);
  EXPECT_NEAR(problem.dot(mx, y), problem.dot(x, my), 1e-5 * std::sqrt(problem.dot(mx, mx) * problem.dot(y, y)));
  ConjugateGradient<Dim> cg(*problem.forest);
  CellField<double, Dim> p(*problem.forest);
  const auto b = field(3, true);
  const auto report = cg.solve(*problem.op, *problem.multigrid, b, p, 1e-6, 100);
  EXPECT_TRUE(report.converged);
  std::cout << Dim << "-D with a box, " << levels << " levels: " << report.iterations << " iterations\n";
  return report.iterations;
}
TEST(Multigrid, ThinWallsKeepTwoSpacesApart) {
  // Walls of one cell of the level below the finest: all coarser cells lie across them.
  const int open = iterations<2>(4), box = iterations_with_a_box<2>(4, 1.0 / 64);
  EXPECT_LE(box, open + 5);  // 7 more if coarse cells lay across the walls
  EXPECT_LE(iterations_with_a_box<3>(3, 1.0 / 16), 13);  // no more than the tank without the box may take
  // The same on one level more: without more smoothing of what no coarse cell stands for it takes 24.
  EXPECT_LE(iterations_with_a_box<2>(5, 1.0 / 16), iterations<2>(5) + 7);
}

TEST(Multigrid, SameBitsForAnyNumberOfThreads) {
  std::vector<double> reference;
  for (const int threads : {1, 2, 4}) {
    Problem<2> problem(4, threads);
    ConjugateGradient<2> cg(*problem.forest);
    CellField<double, 2> x(*problem.forest);
    const auto b = problem.random_field(3);
    const auto report = cg.solve(*problem.op, *problem.multigrid, b, x, 1e-4, 100);
    EXPECT_TRUE(report.converged);
    if (reference.empty()) reference = x.data();
    else EXPECT_EQ(reference, x.data()) << threads << " threads";
  }
}

}  // namespace
}  // namespace seaway::linear
