#include "core/linear/multigrid.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace seaway::linear {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::filled;
using field::for_box;
using field::for_rows;
using field::offset;

namespace {

/// Rounds of smoothing before and after the coarse correction, each one red-black sweep in every block with its
/// neighbours' values of the round before. The neighbours matter: two sweeps in one round converge slower.
constexpr int smoothing_rounds = 3;

/// Rounds more in blocks with gaps and beside them: what no coarse cell corrects is left to the smoothing.
constexpr int rounds_at_gaps = 4;

/// Rounds more in blocks where water meets air, but on the finest level: coarse cells hold both, and what such a cell
/// brings to the air above the surface is poor.
constexpr int rounds_at_jumps = 2;

/// Coefficients of a block further apart than this are those of water and air.
constexpr float density_jump = 30;

template <int Dim>
IVec<Dim> root_cells(const mesh::TankGrid<Dim>& grid) {
  IVec<Dim> n = grid.root_blocks;
  for (int& x : n) x *= BlockShape<Dim>::n;
  return n;
}

/// Lane masks of the two colours along a row.
template <int N>
struct Colours {
  alignas(64) float mask[2][N];
  constexpr Colours() : mask{} {
    for (int i = 0; i < N; ++i) {
      mask[0][i] = i % 2 == 0 ? 1.0f : 0.0f;
      mask[1][i] = i % 2 == 0 ? 0.0f : 1.0f;
    }
  }
};

/// One colour of Gauss-Seidel on a block in the scratch.
template <int Dim>
void half_sweep(const Coefficients<Dim>& k, const float* b, const float* inverse, int colour,
                Scratch<float, Dim>& z) {
  constexpr int n = BlockShape<Dim>::n;
  static constexpr Colours<n> colours;
  for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
    int parity = colour;
    for (int a = 1; a < Dim; ++a) parity += row[a];
    const float* mask = colours.mask[parity & 1];
    float* zr = &z(row);
    float sum[n];
    neighbour_sums<float, Dim>(k, row, zr, sum, nullptr);
    const int o = offset<Dim>(row, cell_strides<Dim>());
    for (int i = 0; i < n; ++i) zr[i] += mask[i] * ((sum[i] + b[o + i]) * inverse[o + i] - zr[i]);
  });
}

template <int Dim>
void store(const Scratch<float, Dim>& z, float* out) {
  constexpr int n = BlockShape<Dim>::n;
  for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
    const float* s = &z(row);
    float* d = out + offset<Dim>(row, cell_strides<Dim>());
    for (int i = 0; i < n; ++i) d[i] = s[i];
  });
}

}  // namespace

template <int Dim>
Multigrid<Dim>::Multigrid(const PoissonOperator<Dim>& op)
    : op_(op), forest_(op.forest()), b_(forest_), z_{CellField<float, Dim>(forest_), CellField<float, Dim>(forest_)},
      current_(static_cast<std::size_t>(forest_.n_blocks()), 0),
      at_gaps_(static_cast<std::size_t>(forest_.n_levels())), at_jumps_(at_gaps_.size()),
      coarse_leaves_(static_cast<std::size_t>(forest_.n_levels())),
      first_coarse_face_(static_cast<std::size_t>(forest_.n_blocks()), -1),
      root_(root_cells(forest_.grid()), forest_.grid().periodic) {
  const auto& faces = forest_.coarse_faces();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    int& first = first_coarse_face_[static_cast<std::size_t>(faces[i].leaf)];
    if (first >= 0) continue;
    first = static_cast<int>(i);
    coarse_leaves_[static_cast<std::size_t>(forest_.block(faces[i].leaf).level)].push_back(faces[i].leaf);
  }
}

template <int Dim>
void Multigrid<Dim>::update() {
  const IVec<Dim> n = root_cells(forest_.grid());
  for (int b = forest_.level_begin(0); b < forest_.level_begin(1); ++b) {
    const mesh::Block<Dim>& block = forest_.block(b);
    for (int axis = 0; axis < Dim; ++axis) {
      const float* c = op_.coefficients().block(axis, b);
      auto& to = root_.coefficients(axis);
      for_box<Dim>(filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        int o = 0, s = 1;
        for (int a = 0; a < Dim; ++a) {
          o += (block.coord[a] * BlockShape<Dim>::n + i[a]) * s;
          s *= n[a] + (a == axis);
        }
        to[static_cast<std::size_t>(o)] = c[offset<Dim>(i, face_strides<Dim>(axis))];
      });
    }
  }
  root_.finish();
  find_blocks_at_gaps();
  find_blocks_at_jumps();
}

template <int Dim>
bool Multigrid<Dim>::has_jump(int b) const {
  float low = std::numeric_limits<float>::max(), high = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    const float* c = op_.coefficients().block(axis, b);
    const auto h2 = static_cast<float>(forest_.block(b).h[axis] * forest_.block(b).h[axis]);
    for (int i = 0; i < BlockShape<Dim>::faces; ++i) {
      if (!(c[i] > 0)) continue;
      low = std::min(low, c[i] * h2);
      high = std::max(high, c[i] * h2);
    }
  }
  return high > density_jump * low;
}

template <int Dim>
void Multigrid<Dim>::find_blocks_at_jumps() {
  std::vector<char> found(static_cast<std::size_t>(forest_.level_begin(forest_.n_levels() - 1)), 0);
  mesh::parallel_for(static_cast<int>(found.size()), forest_.threads(), [&](int b) { found[static_cast<std::size_t>(b)] = has_jump(b); });
  for (int level = 1; level < forest_.n_levels() - 1; ++level) {
    auto& blocks = at_jumps_[static_cast<std::size_t>(level)];
    blocks.clear();
    for (int b = forest_.level_begin(level); b < forest_.level_begin(level + 1); ++b)
      if (found[static_cast<std::size_t>(b)]) blocks.push_back(b);
  }
}

template <int Dim>
void Multigrid<Dim>::find_blocks_at_gaps() {
  std::vector<char> listed(static_cast<std::size_t>(forest_.n_blocks()), 0);
  for (int level = 1; level < forest_.n_levels(); ++level) {
    const int begin = forest_.level_begin(level), end = forest_.level_begin(level + 1);
    auto& blocks = at_gaps_[static_cast<std::size_t>(level)];
    blocks.clear();
    for (int b = begin; b < end; ++b) {
      if (!op_.has_gaps(b)) continue;
      for (const int nb : forest_.block(b).neighbour)  // the block itself is one of them
        if (nb >= begin && nb < end && !std::exchange(listed[static_cast<std::size_t>(nb)], 1)) blocks.push_back(nb);
    }
  }
}

template <int Dim>
void Multigrid<Dim>::smooth_from_zero(int b) {
  Scratch<float, Dim> z;
  std::fill(std::begin(z.data), std::end(z.data), 0.0f);
  const auto k = Coefficients<Dim>::of(op_.coefficients(), b);
  for (int colour = 0; colour < 2; ++colour)
    half_sweep<Dim>(k, b_.block(b), op_.inverse_diagonal().block(b), colour, z);
  store<Dim>(z, this->z(b));
}

template <int Dim>
void Multigrid<Dim>::restrict_residual(int parent) {
  constexpr int n = BlockShape<Dim>::n, half = n / 2;
  float* coarse = b_.block(parent);
  for (int child = 0; child < BlockShape<Dim>::children; ++child) {
    const int b = forest_.block(parent).child[static_cast<std::size_t>(child)];
    Scratch<float, Dim> z;
    load_cells<float, Dim>(this->z(b), z);
    load_ghosts<float, Dim>(forest_, b, CoarseGhost::zero, [&](int nb) { return this->z(nb); }, z);
    const auto k = Coefficients<Dim>::of(op_.coefficients(), b);
    const float* rhs = b_.block(b);
    const float* kept = op_.has_gaps(b) ? op_.kept(b) : nullptr;
    IVec<Dim> base{};
    for (int a = 0; a < Dim; ++a) base[a] = ((child >> a) & 1) * half;
    // Residuals of 2^(Dim-1) rows are added up, then pairs along the row.
    for_rows<Dim>(filled<Dim>(0), [] { IVec<Dim> u = filled<Dim>(half); u[0] = 1; return u; }(), [&](const IVec<Dim>& c) {
      float sum[n] = {};
      for (int s = 0; s < BlockShape<Dim>::children; s += 2) {
        IVec<Dim> row{};
        for (int a = 1; a < Dim; ++a) row[a] = 2 * c[a] + ((s >> a) & 1);
        float neighbours[n], diagonal[n];
        const float* zr = &z(row);
        neighbour_sums<float, Dim>(k, row, zr, neighbours, diagonal);
        const float* br = rhs + offset<Dim>(row, cell_strides<Dim>());
        if (kept) {
          const float* keep = kept + offset<Dim>(row, cell_strides<Dim>());
          for (int i = 0; i < n; ++i) sum[i] += keep[i] * (br[i] - (diagonal[i] * zr[i] - neighbours[i]));
        } else {
          for (int i = 0; i < n; ++i) sum[i] += br[i] - (diagonal[i] * zr[i] - neighbours[i]);
        }
      }
      IVec<Dim> to = c;
      for (int a = 0; a < Dim; ++a) to[a] += base[a];
      to[0] = base[0];
      float* out = coarse + offset<Dim>(to, cell_strides<Dim>());
      for (int i = 0; i < half; ++i) out[i] = sum[2 * i] + sum[2 * i + 1];
    });
  }
}

template <int Dim>
void Multigrid<Dim>::flux_to_coarse(int level) {
  constexpr int n = BlockShape<Dim>::n, half = n / 2;
  const auto& leaves = coarse_leaves_[static_cast<std::size_t>(level)];
  const auto& faces = forest_.coarse_faces();
  mesh::parallel_for(static_cast<int>(leaves.size()), forest_.threads(), [&](int l) {
    const int leaf = leaves[static_cast<std::size_t>(l)];
    float* b = b_.block(leaf);
    for (std::size_t f = static_cast<std::size_t>(first_coarse_face_[static_cast<std::size_t>(leaf)]);
         f < faces.size() && faces[f].leaf == leaf; ++f) {
      const int axis = faces[f].axis, side = faces[f].side;
      const mesh::Block<Dim>& parent = forest_.block(faces[f].parent);
      const IVec<Dim> cs = cell_strides<Dim>(), fs = face_strides<Dim>(axis);
      for (int child = 0; child < BlockShape<Dim>::children; ++child) {
        if (((child >> axis) & 1) != (side == 0 ? 1 : 0)) continue;
        const int fine = parent.child[static_cast<std::size_t>(child)];
        const float* z = this->z(fine);
        const float* c = op_.coefficients().block(axis, fine);
        IVec<Dim> lower, upper;
        side_box<Dim>(axis, 1 - side, lower, upper);
        for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
          IVec<Dim> to{}, face = i;
          if (side == 0) ++face[axis];
          for (int a = 0; a < Dim; ++a)
            to[a] = a == axis ? (side == 0 ? 0 : n - 1) : ((child >> a) & 1) * half + i[a] / 2;
          b[offset<Dim>(to, cs)] += c[offset<Dim>(face, fs)] * z[offset<Dim>(i, cs)];
        });
      }
    }
  });
}

template <int Dim>
void Multigrid<Dim>::correct(int b) {
  const mesh::Block<Dim>& block = forest_.block(b);
  const float* coarse = z(block.parent);
  float* fine = z(b);
  const float* kept = op_.has_gaps(b) ? op_.kept(b) : nullptr;
  IVec<Dim> base{};
  for (int a = 0; a < Dim; ++a) base[a] = (block.coord[a] & 1) * BlockShape<Dim>::n / 2;
  for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
    IVec<Dim> from = base;
    for (int a = 1; a < Dim; ++a) from[a] += row[a] / 2;
    const float* s = coarse + offset<Dim>(from, cell_strides<Dim>());
    float* d = fine + offset<Dim>(row, cell_strides<Dim>());
    if (kept) {
      const float* keep = kept + offset<Dim>(row, cell_strides<Dim>());
      for (int i = 0; i < BlockShape<Dim>::n; ++i) d[i] += keep[i] * s[i / 2];
      return;
    }
    for (int i = 0; i < BlockShape<Dim>::n / 2; ++i) {
      d[2 * i] += s[i];
      d[2 * i + 1] += s[i];
    }
  });
}

template <int Dim>
void Multigrid<Dim>::smooth_again(int b, bool down) {
  Scratch<float, Dim> z;
  load_cells<float, Dim>(this->z(b), z);
  load_ghosts<float, Dim>(forest_, b, down ? CoarseGhost::zero : CoarseGhost::value,
                          [&](int nb) { return this->z(nb); }, z);
  const auto k = Coefficients<Dim>::of(op_.coefficients(), b);
  for (int i = 0; i < 2; ++i)  // upwards in reversed order: symmetric
    half_sweep<Dim>(k, b_.block(b), op_.inverse_diagonal().block(b), down ? i : 1 - i, z);
  store<Dim>(z, z_[1u - current_[static_cast<std::size_t>(b)]].block(b));
}

template <int Dim>
template <class BlockAt>
void Multigrid<Dim>::smooth_round(int count, const BlockAt& block_at, bool down) {
  mesh::parallel_for(count, forest_.threads(), [&](int i) { smooth_again(block_at(i), down); });
  for (int i = 0; i < count; ++i) current_[static_cast<std::size_t>(block_at(i))] ^= 1u;
}

template <int Dim>
void Multigrid<Dim>::smooth_level(int level, bool down) {
  const int begin = forest_.level_begin(level);
  smooth_round(forest_.level_begin(level + 1) - begin, [&](int i) { return begin + i; }, down);
}

template <int Dim>
void Multigrid<Dim>::smooth_blocks(const std::vector<int>& blocks, int rounds, bool down) {
  for (int round = 0; round < rounds; ++round)
    smooth_round(static_cast<int>(blocks.size()), [&](int i) { return blocks[static_cast<std::size_t>(i)]; }, down);
}

template <int Dim>
void Multigrid<Dim>::solve_root() {
  auto& rhs = root_.right_side();
  const IVec<Dim> n = root_cells(forest_.grid());
  const auto each = [&](auto&& f) {
    for (int b = forest_.level_begin(0); b < forest_.level_begin(1); ++b) {
      const mesh::Block<Dim>& block = forest_.block(b);
      for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
        IVec<Dim> g{};
        for (int a = 0; a < Dim; ++a) g[a] = block.coord[a] * BlockShape<Dim>::n + i[a];
        f(b, offset<Dim>(i, cell_strides<Dim>()), g);
      });
    }
  };
  each([&](int b, int cell, const IVec<Dim>& g) {
    int o = 0, s = 1;
    for (int a = 0; a < Dim; ++a) o += g[a] * s, s *= n[a];
    rhs[static_cast<std::size_t>(o)] = b_.block(b)[cell];
  });
  root_.cycle();
  each([&](int b, int cell, const IVec<Dim>& g) { z(b)[cell] = root_.solution()[static_cast<std::size_t>(root_.at(g))]; });
}

template <int Dim>
void Multigrid<Dim>::apply(const CellField<double, Dim>& r) {
  const int threads = forest_.threads();
  const double largest = forest_.max_over_leaves(0.0, [&](int b) {
    double m = 0;
    const double* x = r.block(b);
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) m = std::max(m, std::abs(x[i]));
    return m;
  });
  int exponent = 0;
  if (largest > 0 && std::isfinite(largest)) std::frexp(largest, &exponent);
  scale_ = std::ldexp(1.0, exponent);
  const double shrink = std::ldexp(1.0, -exponent);
  forest_.for_each_leaf([&](int b) {
    const double* x = r.block(b);
    float* y = b_.block(b);
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) y[i] = static_cast<float>(x[i] * shrink);
  });
  for (int level = forest_.n_levels() - 1; level >= 1; --level) {
    const int begin = forest_.level_begin(level), count = forest_.level_begin(level + 1) - begin;
    mesh::parallel_for(count, threads, [&](int i) { smooth_from_zero(begin + i); });
    for (int round = 1; round < smoothing_rounds; ++round) smooth_level(level, true);
    smooth_blocks(at_gaps_[static_cast<std::size_t>(level)], rounds_at_gaps, true);
    smooth_blocks(at_jumps_[static_cast<std::size_t>(level)], rounds_at_jumps, true);
    const int coarse = forest_.level_begin(level - 1), n_coarse = begin - coarse;
    mesh::parallel_for(n_coarse, threads, [&](int i) {
      if (!forest_.block(coarse + i).leaf) restrict_residual(coarse + i);
    });
    flux_to_coarse(level - 1);
  }
  solve_root();
  for (int level = 1; level < forest_.n_levels(); ++level) {
    const int begin = forest_.level_begin(level), count = forest_.level_begin(level + 1) - begin;
    mesh::parallel_for(count, threads, [&](int i) { correct(begin + i); });
    smooth_blocks(at_jumps_[static_cast<std::size_t>(level)], rounds_at_jumps, false);
    smooth_blocks(at_gaps_[static_cast<std::size_t>(level)], rounds_at_gaps, false);
    for (int round = 0; round < smoothing_rounds; ++round) smooth_level(level, false);
  }
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace seaway::linear
