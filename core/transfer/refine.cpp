#include "core/transfer/refine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/error.hpp"
#include "core/field/gather.hpp"

namespace seaway::transfer {
namespace {

using field::for_box;
using field::offset;
using field::Scratch;
using field::ScratchShape;

constexpr double interface_limit = 1e-6;  // below: all air, above 1 - limit: all water

/// The part of its coarse source that a refined leaf covers.
template <int Dim>
struct Place {
  int source = 0;
  IVec<Dim> base{};  ///< first cell of the source
  IVec<Dim> first{},
      last{};  ///< positions along each axis where the source's surroundings carry values

  Place(const Forest<Dim>& from, const Forest<Dim>& to, const BlockSource& s, int b,
        int face_axis) {
    SEAWAY_ASSERT(s.depth == 1);
    constexpr int n = BlockShape<Dim>::n;
    source = s.block;
    const Block<Dim>& coarse = from.block(source);
    for (int a = 0; a < Dim; ++a) {
      base[a] = (to.block(b).coord[a] & 1) * n / 2;
      const auto outside = [&](int side) {
        return coarse.across(a, side) == mesh::no_block;
      };
      first[a] = outside(0) ? 0 : -ScratchShape<Dim>::layers;
      const int end = n - 1 + (a == face_axis);
      last[a] = outside(1) ? end : end + ScratchShape<Dim>::layers;
    }
  }
};

struct Range {
  double low = 0, high = 0;
};

Range stencil_range(const Stencil& s, const double* centre) {
  Range r{centre[s.offset[0]], centre[s.offset[0]]};
  for (const int o : s.offset) {
    r.low = std::min(r.low, centre[o]);
    r.high = std::max(r.high, centre[o]);
  }
  if (s.one_sided) {
    const double spare = 0.5 * (r.high - r.low);
    r.low -= spare;
    r.high += spare;
  }
  return r;
}

void apply(const Stencil& s, const double* centre, double* value) {
  const double* w = s.weight.data();
  for (int t = 0; t < s.targets; ++t, w += s.points) {
    double sum = 0;
    for (int j = 0; j < s.points; ++j) sum += w[j] * centre[s.offset[static_cast<std::size_t>(j)]];
    value[t] = sum;
  }
}

/// Shifts the values to the mean and shrinks their spread into the range.
void keep_mean(double* value, int count, double mean, const Range* range) {
  double sum = 0;
  for (int c = 0; c < count; ++c) sum += value[c];
  sum /= count;
  double theta = 1;
  for (int c = 0; c < count; ++c) {
    value[c] -= sum;
    if (!range) continue;
    if (mean + value[c] > range->high) theta = std::min(theta, (range->high - mean) / value[c]);
    if (mean + value[c] < range->low) theta = std::min(theta, (range->low - mean) / value[c]);
  }
  theta = std::max(theta, 0.0);
  for (int c = 0; c < count; ++c) {
    value[c] = mean + theta * value[c];
    // Rounding alone may leave the range; a mean outside it is kept.
    if (range && mean >= range->low && mean <= range->high)
      value[c] = std::clamp(value[c], range->low, range->high);
  }
}

template <int Dim>
bool near_interface(const Scratch<double, Dim>& vof, const IVec<Dim>& cell) {
  double low = 1, high = 0;
  IVec<Dim> lower = cell, upper = cell;
  for (int a = 0; a < Dim; ++a) --lower[a], upper[a] += 2;
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
    low = std::min(low, vof(i));
    high = std::max(high, vof(i));
  });
  return high > interface_limit && low < 1 - interface_limit;
}

/// Fills the refined leaf's faces of `axis` from the gathered source.
template <int Dim>
std::int64_t refine_block_faces(const Place<Dim>& place, int axis, FaceTables<Dim>& tables,
                                bool limited, const Scratch<double, Dim>& scratch, double* out) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const IVec<Dim> strides = field::face_strides<Dim>(axis);
  std::int64_t fall_backs = 0;
  double value[BlockShape<Dim>::children];
  for (int between = 0; between < 2; ++between) {
    StencilTable<Dim>& table = between ? *tables.between : *tables.on;
    IVec<Dim> upper = field::filled<Dim>(half);
    if (!between) ++upper[axis];
    for_box<Dim>(field::filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
      IVec<Dim> coarse = i;
      for (int a = 0; a < Dim; ++a) coarse[a] += place.base[a];
      const Stencil& s = table.at(coarse, place.first, place.last);
      fall_backs += s.fell_back;
      const double* centre = &scratch(coarse);
      apply(s, centre, value);
      Range range;
      if (limited) range = stencil_range(s, centre);
      if (!between) keep_mean(value, s.targets, *centre, limited ? &range : nullptr);
      int t = 0;
      for (int c = 0; c < BlockShape<Dim>::children; ++c) {
        if ((c >> axis) & 1) continue;
        IVec<Dim> fine{};
        for (int a = 0; a < Dim; ++a) fine[a] = 2 * i[a] + (a == axis ? between : (c >> a) & 1);
        double v = value[t++];
        if (between && limited) v = std::clamp(v, range.low, range.high);
        out[offset<Dim>(fine, strides)] = v;
      }
    });
  }
  return fall_backs;
}

}  // namespace

template <int Dim>
RefineCount refine_cells(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                         StencilTable<Dim>& table, const CellRule& rule,
                         const CellField<double, Dim>& in, CellField<double, Dim>& out,
                         const CellField<double, Dim>* vof) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const IVec<Dim> strides = field::cell_strides<Dim>();
  std::atomic<std::int64_t> fall_backs{0};
  const double lebesgue = to.max_over_leaves(1, [&](int b) {
    const BlockSource& source = pair.source(b);
    if (source.origin != Origin::refined) return 1.0;
    const Place<Dim> place(from, to, source, b, -1);
    Scratch<double, Dim> scratch, water;
    field::gather_cells(from, in, place.source, 2, scratch);
    if (vof) field::gather_cells(from, *vof, place.source, 1, water);
    double* to_block = out.block(b);
    double value[BlockShape<Dim>::children];
    std::int64_t simpler = 0;
    double largest = 1;
    for_box<Dim>(field::filled<Dim>(0), field::filled<Dim>(half), [&](const IVec<Dim>& i) {
      IVec<Dim> coarse = i;
      for (int a = 0; a < Dim; ++a) coarse[a] += place.base[a];
      const Stencil& s = table.at(coarse, place.first, place.last);
      simpler += s.fell_back;
      largest = std::max(largest, s.lebesgue);
      const double* centre = &scratch(coarse);
      apply(s, centre, value);
      Limit limit = rule.limit;
      if (vof && limit == Limit::none && near_interface<Dim>(water, coarse)) limit = Limit::stencil;
      if (limit == Limit::mean) keep_mean(value, s.targets, *centre, nullptr);
      if (limit == Limit::stencil || limit == Limit::bounds) {
        const Range range =
            limit == Limit::bounds ? Range{rule.lower, rule.upper} : stencil_range(s, centre);
        keep_mean(value, s.targets, *centre, &range);
      }
      for (int c = 0; c < BlockShape<Dim>::children; ++c) {
        IVec<Dim> fine{};
        for (int a = 0; a < Dim; ++a) fine[a] = 2 * i[a] + ((c >> a) & 1);
        to_block[offset<Dim>(fine, strides)] = value[c];
      }
    });
    fall_backs += simpler;
    return largest;
  });
  return {fall_backs, lebesgue};
}

template <int Dim>
void unite_faces(const Forest<Dim>& to, const MeshPair<Dim>* pair, int axis,
                 FaceField<double, Dim>& out) {
  constexpr int n = BlockShape<Dim>::n;
  const IVec<Dim> strides = field::face_strides<Dim>(axis);
  // Each shared plane is handled by the block on its upper side alone.
  to.for_each_leaf([&](int b) {
    const int nb = to.block(b).across(axis, 0);
    if (nb < 0 || !to.block(nb).leaf) return;
    const bool kept = pair && pair->source(b).origin == Origin::kept;
    const bool kept_below = pair && pair->source(nb).origin == Origin::kept;
    if (kept && kept_below) return;
    double* own = out.block(axis, b);
    double* below = out.block(axis, nb) + n * strides[axis];
    IVec<Dim> upper = field::cells_upper<Dim>();
    upper[axis] = 1;
    for_box<Dim>(field::filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
      const int o = offset<Dim>(i, strides);
      if (kept)
        below[o] = own[o];
      else
        own[o] = below[o];
    });
  });
}

template <int Dim>
RefineCount refine_faces(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                         std::array<FaceTables<Dim>, Dim>& tables, bool limited,
                         const FaceField<double, Dim>& in, FaceField<double, Dim>& out) {
  std::atomic<std::int64_t> fall_backs{0};
  for (int axis = 0; axis < Dim; ++axis) {
    to.for_each_leaf([&](int b) {
      const BlockSource& source = pair.source(b);
      if (source.origin != Origin::refined) return;
      const Place<Dim> place(from, to, source, b, axis);
      Scratch<double, Dim> scratch;
      // Values beyond the tank's sides are never read, so the kind of boundary does not matter.
      field::gather_faces(from, in, axis, place.source, 2, field::Boundaries<Dim>{}, scratch);
      fall_backs += refine_block_faces<Dim>(place, axis, tables[static_cast<std::size_t>(axis)],
                                            limited, scratch, out.block(axis, b));
    });
    unite_faces(to, &pair, axis, out);
  }
  return {fall_backs, 1};
}

#define SEAWAY_INSTANTIATE(D)                                                                    \
  template RefineCount refine_cells<D>(                                                          \
      const Forest<D>&, const Forest<D>&, const MeshPair<D>&, StencilTable<D>&, const CellRule&, \
      const CellField<double, D>&, CellField<double, D>&, const CellField<double, D>*);          \
  template RefineCount refine_faces<D>(const Forest<D>&, const Forest<D>&, const MeshPair<D>&,   \
                                       std::array<FaceTables<D>, D>&, bool,                      \
                                       const FaceField<double, D>&, FaceField<double, D>&);      \
  template void unite_faces<D>(const Forest<D>&, const MeshPair<D>*, int, FaceField<double, D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
