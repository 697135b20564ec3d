#include "core/linear/dense_multigrid.hpp"

namespace seaway::linear {

using field::filled;
using field::for_box;
using field::for_rows;

template <int Dim>
int DenseMultigrid<Dim>::Grid::padded_stride(int axis) const {
  int s = 1;
  for (int a = 0; a < axis; ++a) s *= n[a] + 2;
  return s;
}
template <int Dim>
int DenseMultigrid<Dim>::Grid::padded(const IVec<Dim>& i) const {
  int o = 0;
  for (int a = 0; a < Dim; ++a) o += (i[a] + 1) * padded_stride(a);
  return o;
}
template <int Dim>
int DenseMultigrid<Dim>::Grid::plain(const IVec<Dim>& i) const {
  int o = 0, s = 1;
  for (int a = 0; a < Dim; ++a) o += i[a] * s, s *= n[a];
  return o;
}
template <int Dim>
int DenseMultigrid<Dim>::Grid::face(const IVec<Dim>& i, int axis) const {
  int o = 0, s = 1;
  for (int a = 0; a < Dim; ++a) o += i[a] * s, s *= n[a] + (a == axis);
  return o;
}

template <int Dim>
DenseMultigrid<Dim>::DenseMultigrid(const IVec<Dim>& cells, const std::array<bool, Dim>& periodic)
    : periodic_(periodic) {
  IVec<Dim> n = cells;
  for (;;) {
    Grid g;
    g.n = n;
    std::size_t count = 1, with_ghosts = 1;
    for (int a = 0; a < Dim; ++a) count *= static_cast<std::size_t>(n[a]), with_ghosts *= static_cast<std::size_t>(n[a] + 2);
    for (int a = 0; a < Dim; ++a)
      g.c[static_cast<std::size_t>(a)].assign(count / static_cast<std::size_t>(n[a]) * static_cast<std::size_t>(n[a] + 1), 0.0f);
    g.b.assign(count, 0.0f);
    g.z.assign(with_ghosts, 0.0f);
    g.inverse_diagonal.assign(count, 0.0f);
    grids_.push_back(std::move(g));
    for (int a = 0; a < Dim; ++a)
      if (n[a] % 2 != 0 || n[a] < 4) return;
    for (int a = 0; a < Dim; ++a) n[a] /= 2;
  }
}

template <int Dim>
void DenseMultigrid<Dim>::finish() {
  for (std::size_t l = 0; l < grids_.size(); ++l) {
    Grid& g = grids_[l];
    if (l > 0) {
      const Grid& fine = grids_[l - 1];
      for (int axis = 0; axis < Dim; ++axis) {
        IVec<Dim> upper = g.n;
        ++upper[axis];
        for_box<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
          float sum = 0;
          for (int s = 0; s < (1 << Dim); ++s) {
            if ((s >> axis) & 1) continue;
            IVec<Dim> at{};
            for (int a = 0; a < Dim; ++a) at[a] = 2 * i[a] + ((s >> a) & 1);
            sum += fine.c[static_cast<std::size_t>(axis)][static_cast<std::size_t>(fine.face(at, axis))];
          }
          g.c[static_cast<std::size_t>(axis)][static_cast<std::size_t>(g.face(i, axis))] = 0.5f * sum;
        });
      }
    }
    for_box<Dim>(filled<Dim>(0), g.n, [&](const IVec<Dim>& i) {
      float diagonal = 0;
      for (int a = 0; a < Dim; ++a) {
        IVec<Dim> up = i;
        ++up[a];
        diagonal += g.c[static_cast<std::size_t>(a)][static_cast<std::size_t>(g.face(i, a))] +
                    g.c[static_cast<std::size_t>(a)][static_cast<std::size_t>(g.face(up, a))];
      }
      g.inverse_diagonal[static_cast<std::size_t>(g.plain(i))] = diagonal > 0 ? 1.0f / diagonal : 0.0f;
    });
  }
}

template <int Dim>
void DenseMultigrid<Dim>::wrap(Grid& g) const {
  for (int a = 0; a < Dim; ++a) {
    if (!periodic_[static_cast<std::size_t>(a)]) continue;
    IVec<Dim> lower = filled<Dim>(0), upper = g.n;
    upper[a] = 1;
    const int stride = g.padded_stride(a), n = g.n[a];
    for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
      float* first = &g.z[static_cast<std::size_t>(g.padded(i))];
      first[-stride] = first[(n - 1) * stride];
      first[n * stride] = first[0];
    });
  }
}

template <int Dim>
void DenseMultigrid<Dim>::smooth(Grid& g, int colour) const {
  wrap(g);
  std::array<int, Dim> stride{};
  for (int a = 0; a < Dim; ++a) stride[static_cast<std::size_t>(a)] = g.padded_stride(a);
  for_rows<Dim>(filled<Dim>(0), g.n, [&](const IVec<Dim>& row) {
    int parity = colour;
    for (int a = 1; a < Dim; ++a) parity += row[a];
    float* z = &g.z[static_cast<std::size_t>(g.padded(row))];
    const float* b = &g.b[static_cast<std::size_t>(g.plain(row))];
    const float* inverse = &g.inverse_diagonal[static_cast<std::size_t>(g.plain(row))];
    const float* lo[Dim];
    const float* hi[Dim];
    for (int a = 0; a < Dim; ++a) {
      IVec<Dim> up = row;
      ++up[a];
      lo[a] = &g.c[static_cast<std::size_t>(a)][static_cast<std::size_t>(g.face(row, a))];
      hi[a] = &g.c[static_cast<std::size_t>(a)][static_cast<std::size_t>(g.face(up, a))];
    }
    for (int i = parity & 1; i < g.n[0]; i += 2) {
      float sum = b[i];
      for (int a = 0; a < Dim; ++a) {
        const int s = stride[static_cast<std::size_t>(a)];
        sum += lo[a][i] * z[i - s] + hi[a][i] * z[i + s];
      }
      z[i] = sum * inverse[i];
    }
  });
}

template <int Dim>
void DenseMultigrid<Dim>::descend(std::size_t level) {
  Grid& g = grids_[level];
  std::fill(g.z.begin(), g.z.end(), 0.0f);
  if (level + 1 == grids_.size()) {
    for (int sweep = 0; sweep < 40; ++sweep) smooth(g, sweep & 1);
    for (int sweep = 0; sweep < 40; ++sweep) smooth(g, (sweep + 1) & 1);
    return;
  }
  for (int sweep = 0; sweep < 4; ++sweep) smooth(g, sweep & 1);
  wrap(g);
  Grid& coarse = grids_[level + 1];
  std::fill(coarse.b.begin(), coarse.b.end(), 0.0f);
  for_box<Dim>(filled<Dim>(0), g.n, [&](const IVec<Dim>& i) {
    const float* z = &g.z[static_cast<std::size_t>(g.padded(i))];
    float r = g.b[static_cast<std::size_t>(g.plain(i))];
    for (int a = 0; a < Dim; ++a) {
      IVec<Dim> up = i;
      ++up[a];
      const int s = g.padded_stride(a);
      r -= g.c[static_cast<std::size_t>(a)][static_cast<std::size_t>(g.face(i, a))] * (z[0] - z[-s]) +
           g.c[static_cast<std::size_t>(a)][static_cast<std::size_t>(g.face(up, a))] * (z[0] - z[s]);
    }
    IVec<Dim> c = i;
    for (int& x : c) x /= 2;
    coarse.b[static_cast<std::size_t>(coarse.plain(c))] += r;
  });
  descend(level + 1);
  for_box<Dim>(filled<Dim>(0), g.n, [&](const IVec<Dim>& i) {
    IVec<Dim> c = i;
    for (int& x : c) x /= 2;
    g.z[static_cast<std::size_t>(g.padded(i))] += coarse.z[static_cast<std::size_t>(coarse.padded(c))];
  });
  for (int sweep = 0; sweep < 4; ++sweep) smooth(g, (sweep + 1) & 1);
}

template <int Dim>
void DenseMultigrid<Dim>::cycle() {
  descend(0);
}

template class DenseMultigrid<2>;
template class DenseMultigrid<3>;

}  // namespace seaway::linear
