#include "core/transfer/stencil.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace seaway::transfer {

using mesh::BlockShape;

template <int Dim>
StencilTable<Dim>::StencilTable(const IVec<Dim>& lower, const IVec<Dim>& upper,
                                std::vector<Vec<Dim>> targets, WeightRule<Dim> rule)
    : lower_(lower), upper_(upper), targets_(std::move(targets)), rule_(std::move(rule)) {
  std::size_t states = 1;
  for (int a = 0; a < Dim; ++a) {
    SEAWAY_ASSERT(lower[a] >= -2 && upper[a] <= 3);
    states *= max_states;
  }
  stencil_.resize(states);
  build(0, lower_, upper_);
}

template <int Dim>
const Stencil& StencilTable<Dim>::at(const IVec<Dim>& i, const IVec<Dim>& first,
                                     const IVec<Dim>& last) {
  std::size_t state = 0;
  IVec<Dim> lower = lower_, upper = upper_;
  for (int a = Dim - 1; a >= 0; --a) {
    const int below = std::max(0, first[a] - (i[a] + lower_[a]));
    const int above = std::max(0, i[a] + upper_[a] - last[a]);
    // A block is wider than a stencil: layers are missing on one side at most.
    state = state * max_states + static_cast<std::size_t>(below > 0 ? below : above > 0 ? above + 3 : 0);
    lower[a] += below;
    upper[a] -= above;
  }
  if (state == 0) return *stencil_[0];
  const std::lock_guard lock(mutex_);
  if (!stencil_[state]) return build(state, lower, upper);
  return *stencil_[state];
}

template <int Dim>
const Stencil& StencilTable<Dim>::build(std::size_t state, const IVec<Dim>& lower,
                                        const IVec<Dim>& upper) {
  auto s = std::make_unique<Stencil>();
  std::vector<Vec<Dim>> points;
  IVec<Dim> end = upper;
  for (int& e : end) ++e;
  field::for_box<Dim>(lower, end, [&](const IVec<Dim>& i) {
    Vec<Dim> x;
    int o = 0;
    for (int a = 0; a < Dim; ++a) {
      x[a] = i[a];
      o += i[a] * field::ScratchShape<Dim>::stride(a);
    }
    points.push_back(x);
    s->offset.push_back(o);
  });
  const PointWeights w = rule_(points, targets_);
  s->points = static_cast<int>(points.size());
  s->targets = static_cast<int>(targets_.size());
  for (int t = 0; t < s->targets; ++t)
    for (int j = 0; j < s->points; ++j) s->weight.push_back(w.weight(t, j));
  s->lebesgue = w.lebesgue;
  s->fell_back = w.fell_back;
  s->one_sided = state != 0;
  stencil_[state] = std::move(s);
  return *stencil_[state];
}

namespace {

/// Children with bit `axis` clear (axis < 0: all), a quarter spacing off the origin along the other axes.
template <int Dim>
std::vector<Vec<Dim>> quarter_points(int axis, double along) {
  std::vector<Vec<Dim>> targets;
  for (int c = 0; c < BlockShape<Dim>::children; ++c) {
    if (axis >= 0 && ((c >> axis) & 1)) continue;
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = a == axis ? along : ((c >> a) & 1 ? 0.25 : -0.25);
    targets.push_back(x);
  }
  return targets;
}

}  // namespace

template <int Dim>
std::unique_ptr<StencilTable<Dim>> child_cells(int radius, WeightRule<Dim> rule) {
  return std::make_unique<StencilTable<Dim>>(field::filled<Dim>(-radius), field::filled<Dim>(radius),
                                             quarter_points<Dim>(-1, 0), std::move(rule));
}

template <int Dim>
std::unique_ptr<StencilTable<Dim>> faces_on(int axis, int radius, WeightRule<Dim> rule) {
  return std::make_unique<StencilTable<Dim>>(field::filled<Dim>(-radius), field::filled<Dim>(radius),
                                             quarter_points<Dim>(axis, 0), std::move(rule));
}

template <int Dim>
std::unique_ptr<StencilTable<Dim>> faces_between(int axis, int radius, WeightRule<Dim> rule) {
  IVec<Dim> upper = field::filled<Dim>(radius);
  ++upper[axis];
  return std::make_unique<StencilTable<Dim>>(field::filled<Dim>(-radius), upper,
                                             quarter_points<Dim>(axis, 0.5), std::move(rule));
}

#define SEAWAY_INSTANTIATE(D)                                                                    \
  template class StencilTable<D>;                                                                \
  template std::unique_ptr<StencilTable<D>> child_cells<D>(int, WeightRule<D>);                  \
  template std::unique_ptr<StencilTable<D>> faces_on<D>(int, int, WeightRule<D>);                \
  template std::unique_ptr<StencilTable<D>> faces_between<D>(int, int, WeightRule<D>);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
