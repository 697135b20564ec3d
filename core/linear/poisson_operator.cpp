#include "core/linear/poisson_operator.hpp"

#include <algorithm>

namespace seaway::linear {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::filled;
using field::for_box;
using field::for_rows;
using field::offset;

template <int Dim>
PoissonOperator<Dim>::PoissonOperator(const Forest<Dim>& forest)
    : forest_(forest), c_(forest), inverse_diagonal_(forest), kept_(forest, 1.0f), size_(forest, 1.0f),
      has_gaps_(static_cast<std::size_t>(forest.n_blocks()), 0),
      first_coarse_face_(static_cast<std::size_t>(forest.n_blocks()), -1) {
  const auto& faces = forest.coarse_faces();
  for (std::size_t i = faces.size(); i-- > 0;)
    first_coarse_face_[static_cast<std::size_t>(faces[i].leaf)] = static_cast<int>(i);
}

namespace {

/// Pieces of a group of 2^Dim cells: cells joined by open faces get the same number, the lowest of theirs.
template <int Dim, class Open>
std::array<int, BlockShape<Dim>::children> pieces_of_group(Open&& open) {
  constexpr int children = BlockShape<Dim>::children;
  std::array<int, children> piece;
  for (int s = 0; s < children; ++s) piece[static_cast<std::size_t>(s)] = s;
  for (bool again = true; again;) {
    again = false;
    for (int s = 0; s < children; ++s) {
      for (int a = 0; a < Dim; ++a) {
        const int t = s | (1 << a);
        int &one = piece[static_cast<std::size_t>(s)], &other = piece[static_cast<std::size_t>(t)];
        if (t == s || one == other || !open(t, a)) continue;
        one = other = std::min(one, other);
        again = true;
      }
    }
  }
  return piece;
}

}  // namespace

/// Of each group of 2^Dim cells of block b that one coarse cell covers, the largest connected piece is kept.
template <int Dim>
void PoissonOperator<Dim>::find_pieces(int b) {
  constexpr int n = BlockShape<Dim>::n, children = BlockShape<Dim>::children;
  bool walls = false;
  for (int axis = 0; axis < Dim && !walls; ++axis) {
    const float* c = c_.block(axis, b);
    IVec<Dim> lower = filled<Dim>(0), upper = field::faces_upper<Dim>(axis);
    ++lower[axis];
    --upper[axis];
    float least = 1;
    const int count = upper[0] - lower[0];
    for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
      const float* x = c + offset<Dim>(row, face_strides<Dim>(axis));
      for (int i = 0; i < count; ++i) least = std::min(least, x[i]);
    });
    walls = !(least > 0);
  }
  float *kept = kept_.block(b), *size = size_.block(b);
  char& gaps = has_gaps_[static_cast<std::size_t>(b)];
  if (gaps) std::fill_n(kept, BlockShape<Dim>::cells, 1.0f);
  gaps = 0;
  const mesh::Block<Dim>& block = forest_.block(b);
  IVec<Dim> base{};
  for (int a = 0; a < Dim; ++a) base[a] = (block.coord[a] & 1) * n / 2;
  float* above = size_.block(block.parent);
  const float whole_group = static_cast<float>(children);
  for_box<Dim>(filled<Dim>(0), filled<Dim>(n / 2), [&](const IVec<Dim>& group) {
    const auto cell = [&](int s) {
      IVec<Dim> i{};
      for (int a = 0; a < Dim; ++a) i[a] = 2 * group[a] + ((s >> a) & 1);
      return i;
    };
    IVec<Dim> to = group;
    for (int a = 0; a < Dim; ++a) to[a] += base[a];
    float& coarse_size = above[offset<Dim>(to, cell_strides<Dim>())];
    coarse_size = 1;
    if (!walls) return;
    const auto piece = pieces_of_group<Dim>([&](int s, int axis) {
      return c_.block(axis, b)[offset<Dim>(cell(s), face_strides<Dim>(axis))] > 0;
    });
    float sum[children] = {}, total = 0;
    for (int s = 0; s < children; ++s) {
      const IVec<Dim> i = cell(s);
      bool open = false;
      for (int a = 0; a < Dim && !open; ++a) {
        const float* c = c_.block(a, b) + offset<Dim>(i, face_strides<Dim>(a));
        open = c[0] > 0 || c[face_strides<Dim>(a)[a]] > 0;
      }
      const float part = open ? size[offset<Dim>(i, cell_strides<Dim>())] / whole_group : 0.0f;
      sum[piece[static_cast<std::size_t>(s)]] += part;
      total += part;
    }
    const int largest = static_cast<int>(std::max_element(sum, sum + children) - sum);
    coarse_size = sum[largest];
    if (!(sum[largest] < total)) return;
    gaps = 1;
    for (int s = 0; s < children; ++s)
      if (piece[static_cast<std::size_t>(s)] != largest) kept[offset<Dim>(cell(s), cell_strides<Dim>())] = 0;
  });
}

/// Cell of block b or one beyond its sides; finer and coarser neighbours have no gaps.
template <int Dim>
bool PoissonOperator<Dim>::is_kept(int b, IVec<Dim> cell) const {
  constexpr int n = BlockShape<Dim>::n;
  for (int a = 0; a < Dim; ++a) {
    if (cell[a] >= 0 && cell[a] < n) continue;
    const int side = cell[a] < 0 ? 0 : 1;
    b = forest_.block(b).across(a, side);
    if (b < 0) return true;
    cell[a] += side == 0 ? n : -n;
  }
  return !has_gaps(b) || kept_.block(b)[offset<Dim>(cell, cell_strides<Dim>())] > 0;
}

template <int Dim>
void PoissonOperator<Dim>::restrict_coefficients(int parent) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const mesh::Block<Dim>& block = forest_.block(parent);
  for (int axis = 0; axis < Dim; ++axis) {
    const IVec<Dim> strides = face_strides<Dim>(axis);
    float* coarse = c_.block(axis, parent);
    for (int child = 0; child < BlockShape<Dim>::children; ++child) {
      const int from = block.child[static_cast<std::size_t>(child)];
      const float* fine = c_.block(axis, from);
      bool gaps = has_gaps(from);
      for (int side = 0; side < 2; ++side) {
        const int nb = forest_.block(from).across(axis, side);
        gaps = gaps || (nb >= 0 && has_gaps(nb));
      }
      IVec<Dim> upper = filled<Dim>(half);
      ++upper[axis];
      for_box<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
        float sum = 0;
        for (int s = 0; s < BlockShape<Dim>::children; ++s) {
          if ((s >> axis) & 1) continue;
          IVec<Dim> at{};
          for (int a = 0; a < Dim; ++a) at[a] = 2 * i[a] + ((s >> a) & 1);
          if (gaps) {
            IVec<Dim> below = at;
            --below[axis];
            if (!is_kept(from, at) || !is_kept(from, below)) continue;
          }
          const float c = fine[offset<Dim>(at, strides)];
          sum += c;
        }
        IVec<Dim> to{};
        for (int a = 0; a < Dim; ++a) to[a] = ((child >> a) & 1) * half + i[a];
        coarse[offset<Dim>(to, strides)] = 0.5f * sum;
      });
    }
    // Next to a leaf of its own level the children's distances are 3/4 of the coarse cell, not 1/2.
    for (int side = 0; side < 2; ++side) {
      const int nb = block.across(axis, side);
      if (nb < 0 || !forest_.block(nb).leaf) continue;
      const int shift = (side == 0 ? BlockShape<Dim>::n : -BlockShape<Dim>::n) * strides[axis];
      float* leaf = c_.block(axis, nb);
      field::for_side_faces<Dim>(axis, side, [&](int o) {
        coarse[o] *= 1.5f;
        leaf[o + shift] = coarse[o];
      });
    }
  }
}

template <int Dim>
void PoissonOperator<Dim>::finish() {
  for (int level = forest_.n_levels() - 2; level >= 0; --level) {
    const int begin = forest_.level_begin(level), end = forest_.level_begin(level + 1);
    const int fine_end = forest_.level_begin(level + 2);
    mesh::parallel_for(fine_end - end, forest_.threads(), [&](int i) { find_pieces(end + i); });
    mesh::parallel_for(end - begin, forest_.threads(), [&](int i) {
      if (!forest_.block(begin + i).leaf) restrict_coefficients(begin + i);
    });
  }
  mesh::parallel_for(forest_.n_blocks(), forest_.threads(), [&](int b) {
    const auto k = Coefficients<Dim>::of(c_, b);
    float* inverse = inverse_diagonal_.block(b);
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      constexpr int n = BlockShape<Dim>::n;
      float diagonal[n];
      const float* c0 = k.c[0] + offset<Dim>(row, face_strides<Dim>(0));
      for (int i = 0; i < n; ++i) diagonal[i] = c0[i] + c0[i + 1];
      for (int a = 1; a < Dim; ++a) {
        const IVec<Dim> fs = face_strides<Dim>(a);
        const float* lo = k.c[static_cast<std::size_t>(a)] + offset<Dim>(row, fs);
        for (int i = 0; i < n; ++i) diagonal[i] += lo[i] + lo[i + fs[a]];
      }
      float* out = inverse + offset<Dim>(row, cell_strides<Dim>());
      for (int i = 0; i < n; ++i) out[i] = diagonal[i] > 0 ? 1.0f / diagonal[i] : 0.0f;
    });
  });
}

template <int Dim>
void PoissonOperator<Dim>::conservative_ghosts(const mesh::CoarseFace& face, const CellField<double, Dim>& p,
                                               Scratch<double, Dim>& z) const {
  constexpr int n = BlockShape<Dim>::n, half = n / 2;
  const int axis = face.axis;
  const mesh::Block<Dim>& parent = forest_.block(face.parent);
  const IVec<Dim> cs = cell_strides<Dim>(), fs = face_strides<Dim>(axis);
  const int step = ScratchShape<Dim>::stride(axis) * (face.side == 0 ? -1 : 1);
  IVec<Dim> lower, upper;
  side_box<Dim>(axis, face.side, lower, upper);
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
    // Fine cells behind coarse cell i: in the children on the parent's facing side.
    double weighted = 0, weight = 0;
    for (int s = 0; s < BlockShape<Dim>::children; ++s) {
      if ((s >> axis) & 1) continue;
      IVec<Dim> at{};
      int child = 0;
      for (int a = 0; a < Dim; ++a) {
        if (a == axis) {
          at[a] = face.side == 0 ? n - 1 : 0;
          child |= (face.side == 0 ? 1 : 0) << a;
        } else {
          const int fine = 2 * i[a] + ((s >> a) & 1);
          child |= (i[a] >= half ? 1 : 0) << a;
          at[a] = fine % n;
        }
      }
      const int b = parent.child[static_cast<std::size_t>(child)];
      IVec<Dim> f = at;
      if (face.side == 0) ++f[axis];
      const double c = c_.block(axis, b)[offset<Dim>(f, fs)];
      weighted += c * p.block(b)[offset<Dim>(at, cs)];
      weight += c;
    }
    // The row's own coefficient (3/4 of the sum, rounded to float) times this difference is the sum of the
    // fine fluxes, exactly as the fine rows have it.
    IVec<Dim> f = i;
    if (face.side == 1) ++f[axis];
    const double c = c_.block(axis, face.leaf)[offset<Dim>(f, fs)];
    const double own = z(i);
    (&z(i))[step] = c > 0 ? own + (weighted - weight * own) / c : own;
  });
}

template <int Dim>
double PoissonOperator<Dim>::apply(const CellField<double, Dim>& p, CellField<double, Dim>& out) const {
  constexpr int n = BlockShape<Dim>::n;
  const auto& coarse_faces = forest_.coarse_faces();
  double dot = forest_.sum_over_leaves([&](int b) {
    Scratch<double, Dim> z;
    load_cells<double, Dim>(p.block(b), z);
    load_ghosts<double, Dim>(forest_, b, CoarseGhost::value, [&](int nb) { return p.block(nb); }, z);
    for (int f = first_coarse_face_[static_cast<std::size_t>(b)];
         f >= 0 && f < static_cast<int>(coarse_faces.size()) && coarse_faces[static_cast<std::size_t>(f)].leaf == b; ++f)
      conservative_ghosts(coarse_faces[static_cast<std::size_t>(f)], p, z);
    const auto k = Coefficients<Dim>::of(c_, b);
    double* q = out.block(b);
    double lanes[n] = {};
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      double sum[n], diagonal[n];
      const double* zr = &z(row);
      neighbour_sums<double, Dim>(k, row, zr, sum, diagonal);
      double* qr = q + offset<Dim>(row, cell_strides<Dim>());
      for (int i = 0; i < n; ++i) {
        qr[i] = diagonal[i] * zr[i] - sum[i];
        lanes[i] += qr[i] * zr[i];
      }
    });
    double total = 0;
    for (const double x : lanes) total += x;
    return total;
  });
  if (!rigid_.cell.empty()) {
    const auto force = rigid_.gather(p.data());
    const Eigen::Matrix<double, n_dof<Dim>, 1> twist = rigid_.inverse_mass * force;
    for (std::size_t i = 0; i < rigid_.cell.size(); ++i)
      out.data()[static_cast<std::size_t>(rigid_.cell[i])] += rigid_.j[i].dot(twist);
    dot += force.dot(twist);
  }
  return dot;
}

template class PoissonOperator<2>;
template class PoissonOperator<3>;

}  // namespace seaway::linear
