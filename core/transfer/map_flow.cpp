#include "core/transfer/map_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/run_context.hpp"
#include "core/field/restrict.hpp"
#include "core/transfer/coarsen.hpp"
#include "core/transfer/linear.hpp"
#include "core/transfer/local_rbf.hpp"
#include "core/transfer/prbf_flow.hpp"
#include "core/transfer/split_vof.hpp"

namespace seaway::transfer {
namespace {

template <int Dim>
void restrict_all(const Forest<Dim>& forest, FlowFields<Dim>& f) {
  if (is_set(f.vof)) field::restrict_cells(forest, f.vof);
  if (is_set(f.p)) field::restrict_cells(forest, f.p);
  if (is_set(f.u)) field::restrict_faces(forest, f.u);
  if (is_set(f.w)) field::restrict_faces(forest, f.w);
  for (auto& e : f.extra) field::restrict_cells(forest, e);
}

/// The stencils of one method, made once for all fields and steps.
template <int Dim>
struct Tables {
  std::unique_ptr<StencilTable<Dim>> cells;
  std::array<FaceTables<Dim>, Dim> faces;

  explicit Tables(const MapOptions& options) {
    const bool linear = options.method == MapMethod::linear;
    const int radius = linear ? 1 : options.radius;
    const WeightRule<Dim> rule =
        linear ? linear_rule<Dim>() : rbf_rule<Dim>({options.degree, options.lebesgue_limit});
    cells = child_cells<Dim>(radius, rule);
    for (int axis = 0; axis < Dim; ++axis) {
      auto& t = faces[static_cast<std::size_t>(axis)];
      t.on = faces_on<Dim>(axis, radius, rule);
      t.between = faces_between<Dim>(axis, radius, rule);
    }
  }
};

/// One step of forests_between.
template <int Dim>
class Step {
 public:
  Step(const MapOptions& options, Tables<Dim>& tables, const Forest<Dim>& from, const Forest<Dim>& to)
      : options_(options), tables_(tables), from_(from), to_(to), pair_(from, to) {}

  FlowFields<Dim> map(const FlowFields<Dim>& in, RefineCount& count) {
    FlowFields<Dim> out;
    map_vof(in, out, count);
    const CellField<double, Dim>* vof = is_set(in.vof) ? &in.vof : nullptr;
    map_cells(in.p, CellRule{Limit::none}, vof, out.p, count);
    map_faces(in.u, out.u, count);
    map_faces(in.w, out.w, count);
    out.extra.resize(in.extra.size());
    for (std::size_t e = 0; e < in.extra.size(); ++e)
      map_cells(in.extra[e], CellRule{Limit::stencil}, nullptr, out.extra[e], count);
    restrict_all(to_, out);
    return out;
  }

 private:
  void map_vof(const FlowFields<Dim>& in, FlowFields<Dim>& out, RefineCount& count) {
    if (!is_set(in.vof)) return;
    if (options_.vof == VofMethod::bounded) {
      map_cells(in.vof, CellRule{Limit::bounds, 0, 1}, nullptr, out.vof, count);
      return;
    }
    out.vof = CellField<double, Dim>(to_);
    copy_or_coarsen(from_, to_, pair_, in.vof, out.vof);
    split_vof(from_, to_, pair_, in.vof, out.vof);
  }

  void map_cells(const CellField<double, Dim>& in, const CellRule& rule, const CellField<double, Dim>* vof,
                 CellField<double, Dim>& out, RefineCount& count) {
    if (!is_set(in)) return;
    out = CellField<double, Dim>(to_);
    copy_or_coarsen(from_, to_, pair_, in, out);
    count.add(refine_cells(from_, to_, pair_, *tables_.cells, rule, in, out, vof));
  }

  void map_faces(const FaceField<double, Dim>& in, FaceField<double, Dim>& out, RefineCount& count) {
    if (!is_set(in)) return;
    out = FaceField<double, Dim>(to_);
    copy_or_coarsen(from_, to_, pair_, in, out);
    count.add(refine_faces<Dim>(from_, to_, pair_, tables_.faces, options_.limit_velocity, in, out));
  }

  const MapOptions& options_;
  Tables<Dim>& tables_;
  const Forest<Dim>& from_;
  const Forest<Dim>& to_;
  const MeshPair<Dim> pair_;
};

std::string name_of(MapMethod method) {
  switch (method) {
    case MapMethod::local_rbf: return "local-rbf";
    case MapMethod::linear: return "linear";
    case MapMethod::prbf: return "prbf";
  }
  return "";
}

template <int Dim>
void describe_mesh(const MapOptions& options, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                   MapReport& report) {
  report.method = name_of(options.method);
  report.origin.assign(static_cast<std::size_t>(to.n_blocks()) * BlockShape<Dim>::cells, 0);
  const bool none_kept = options.method == MapMethod::prbf && options.prbf.evaluate_all;
  for (const int b : to.leaves()) {
    Origin origin = pair.source(b).origin;
    if (none_kept) origin = Origin::refined;
    constexpr int cells = BlockShape<Dim>::cells;
    std::fill_n(report.origin.begin() + static_cast<std::ptrdiff_t>(b) * cells, cells,
                static_cast<char>(origin));
    (origin == Origin::kept ? report.kept_cells
     : origin == Origin::refined ? report.refined_cells : report.coarsened_cells) += cells;
  }
  report.new_cells = report.refined_cells + report.coarsened_cells;
}

template <int Dim>
void describe_vof(const Forest<Dim>& to, const CellField<double, Dim>& vof, MapReport& report) {
  report.vof_min = std::numeric_limits<double>::infinity();
  report.vof_max = -report.vof_min;
  for (const int b : to.leaves()) {
    const auto [low, high] = std::minmax_element(vof.block(b), vof.block(b) + BlockShape<Dim>::cells);
    report.vof_min = std::min(report.vof_min, *low);
    report.vof_max = std::max(report.vof_max, *high);
  }
}

}  // namespace

template <int Dim>
double volume_integral(const Forest<Dim>& forest, const CellField<double, Dim>& f) {
  double sum = 0, lost = 0;
  for (const int b : forest.leaves()) {
    const double volume = forest.block(b).cell_volume();
    const double* v = f.block(b);
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      const double x = v[i] * volume, next = sum + x;
      lost += std::abs(sum) >= std::abs(x) ? (sum - next) + x : (x - next) + sum;
      sum = next;
    }
  }
  return sum + lost;
}

template <int Dim>
double max_divergence(const Forest<Dim>& forest, const FaceField<double, Dim>& w) {
  return forest.max_over_leaves(0, [&](int b) {
    double largest = 0;
    const Vec<Dim>& h = forest.block(b).h;
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      double sum = 0;
      for (int a = 0; a < Dim; ++a) {
        const IVec<Dim> strides = field::face_strides<Dim>(a);
        const double* face = w.block(a, b) + field::offset<Dim>(i, strides);
        sum += (face[strides[a]] - face[0]) / h[a];
      }
      if (!(std::abs(sum) <= largest)) largest = std::abs(sum);
    });
    return largest;
  });
}

template <int Dim>
MapReport map_flow(const MapOptions& options, const Forest<Dim>& from, const Forest<Dim>& to,
                   const FlowFields<Dim>& in, FlowFields<Dim>& out) {
  SEAWAY_CHECK(options.degree == 1 || options.degree == 2,
               "mapping tail degree {} is not supported; use 1 or 2", options.degree);
  SEAWAY_CHECK(options.radius == 1 || options.radius == 2,
               "mapping stencil radius {} is not supported; use 1 or 2", options.radius);
  SEAWAY_ASSERT(&in != &out);
  const double start = process_cpu_seconds();
  const MeshPair<Dim> pair(from, to);
  const auto between = forests_between(from, to);
  MapReport report;
  if (is_set(in.vof)) report.water_before = volume_integral(from, in.vof);
  if (is_set(in.w)) report.divergence_before = max_divergence(from, in.w);

  FlowFields<Dim> current = in;
  restrict_all(from, current);
  Tables<Dim> tables(options);
  RefineCount count;
  const Forest<Dim>* at = &from;
  for (std::size_t k = 0; k <= between.size(); ++k) {
    const Forest<Dim>* next = k < between.size() ? between[k].get() : &to;
    current = Step<Dim>(options, tables, *at, *next).map(current, count);
    at = next;
  }
  out = std::move(current);

  if (options.method == MapMethod::prbf) {
    const bool with_vof = options.vof == VofMethod::bounded;
    FlowFields<Dim> source = in;  // coarse faces at level jumps hold the means of the fine ones
    restrict_all(from, source);
    const PrbfReport prbf = prbf_flow(options.prbf, from, to, pair, with_vof, source, out);
    restrict_all(to, out);
    count = {prbf.degenerate + prbf.indefinite, 1};
  }
  describe_mesh(options, to, pair, report);
  report.fall_backs = count.fall_backs;
  report.lebesgue = count.lebesgue;
  if (is_set(out.vof)) {
    describe_vof(to, out.vof, report);
    report.water_after = volume_integral(to, out.vof);
  }
  if (is_set(out.w)) report.divergence_after = max_divergence(to, out.w);
  report.cpu_s = process_cpu_seconds() - start;
  return report;
}

#define SEAWAY_INSTANTIATE(D)                                                                      \
  template MapReport map_flow<D>(const MapOptions&, const Forest<D>&, const Forest<D>&,            \
                                 const FlowFields<D>&, FlowFields<D>&);                            \
  template double volume_integral<D>(const Forest<D>&, const CellField<double, D>&);               \
  template double max_divergence<D>(const Forest<D>&, const FaceField<double, D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
