#include "core/transfer/prbf_flow.hpp"

#include <algorithm>

#include "core/transfer/refine.hpp"

namespace seaway::transfer {
namespace {

using field::offset;
using mesh::no_block;

/// A cell or face: block and index inside it.
template <int Dim>
struct Place {
  int block;
  int offset;
};

template <int Dim>
struct PointSet {
  std::vector<Vec<Dim>> position;
  std::vector<Place<Dim>> place;
};

/// Cells of the leaves for which wanted(leaf).
template <int Dim, class Wanted>
PointSet<Dim> cells_of(const Forest<Dim>& forest, Wanted&& wanted) {
  PointSet<Dim> set;
  for (const int b : forest.leaves()) {
    if (!wanted(b)) continue;
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      set.position.push_back(forest.block(b).cell_centre(i));
      set.place.push_back({b, offset<Dim>(i, field::cell_strides<Dim>())});
    });
  }
  return set;
}

/// Faces of `axis` of the leaves. Those on a leaf's sides only if side_wanted(leaf, side), side 0
/// or 1.
template <int Dim, class Wanted, class SideWanted>
PointSet<Dim> faces_of(const Forest<Dim>& forest, int axis, Wanted&& wanted,
                       SideWanted&& side_wanted) {
  constexpr int n = BlockShape<Dim>::n;
  PointSet<Dim> set;
  for (const int b : forest.leaves()) {
    if (!wanted(b)) continue;
    const bool lower = side_wanted(b, 0), upper = side_wanted(b, 1);
    field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis),
                        [&](const IVec<Dim>& i) {
                          if ((i[axis] == 0 && !lower) || (i[axis] == n && !upper)) return;
                          set.position.push_back(forest.block(b).face_centre(i, axis));
                          set.place.push_back({b, offset<Dim>(i, field::face_strides<Dim>(axis))});
                        });
  }
  return set;
}

/// Whether the leaf's side is where each face is listed once: by the finer block, of two alike the
/// upper.
template <int Dim>
bool lists_side(const Forest<Dim>& forest, int b, int axis, int side) {
  const int nb = forest.block(b).across(axis, side);
  if (nb < 0) return true;  // tank's side, or a coarser leaf
  return forest.block(nb).leaf && side == 0;
}

/// Whether faces on this side may be overwritten.
template <int Dim>
bool side_is_free(const Forest<Dim>& to, const MeshPair<Dim>& pair, bool all, int b, int axis,
                  int side) {
  int nb = to.block(b).across(axis, side);
  if (nb == no_block) return false;
  if (nb == mesh::coarser_neighbour) nb = to.block(to.block(b).parent).across(axis, side);
  if (nb < 0 || !to.block(nb).leaf) return true;  // finer: restricted afterwards
  return all || pair.source(nb).origin != Origin::kept;
}

}  // namespace

template <int Dim>
PrbfReport prbf_flow(const PrbfOptions& options, const Forest<Dim>& from, const Forest<Dim>& to,
                     const MeshPair<Dim>& pair, bool with_vof, const FlowFields<Dim>& in,
                     FlowFields<Dim>& out) {
  const bool all = options.evaluate_all;
  const auto every = [](int) { return true; };
  const auto wanted = [&](int b) { return all || pair.source(b).origin != Origin::kept; };
  PrbfReport report;
  // get(f, b) and set(f, b): block b of the f-th field, to read and to write.
  const auto interpolate = [&](const PointSet<Dim>& points, const PointSet<Dim>& targets,
                               int fields, auto&& get, auto&& set) {
    if (fields == 0 || targets.position.empty()) return;
    Eigen::MatrixXd values(static_cast<Eigen::Index>(points.place.size()), fields);
    for (std::size_t i = 0; i < points.place.size(); ++i)
      for (int f = 0; f < fields; ++f)
        values(static_cast<Eigen::Index>(i), f) =
            get(f, points.place[i].block)[points.place[i].offset];
    PrbfReport part;
    const Eigen::MatrixXd result = prbf_interpolate<Dim>(options, points.position, values,
                                                         targets.position, to.threads(), &part);
    for (std::size_t t = 0; t < targets.place.size(); ++t)
      for (int f = 0; f < fields; ++f)
        set(f, targets.place[t].block)[targets.place[t].offset] =
            result(static_cast<Eigen::Index>(t), f);
    report.subsets = part.subsets;
    report.subset_size = std::max(report.subset_size, part.subset_size);
    report.memory = std::max(report.memory, part.memory);
    report.degenerate += part.degenerate;
    report.indefinite += part.indefinite;
    report.factor_cpu_s += part.factor_cpu_s;
    report.evaluate_cpu_s += part.evaluate_cpu_s;
  };

  std::vector<const CellField<double, Dim>*> cells_in;
  std::vector<CellField<double, Dim>*> cells_out;
  if (is_set(in.p)) cells_in.push_back(&in.p), cells_out.push_back(&out.p);
  for (std::size_t e = 0; e < in.extra.size(); ++e)
    cells_in.push_back(&in.extra[e]), cells_out.push_back(&out.extra[e]);
  const bool vof = with_vof && is_set(in.vof);
  if (vof) cells_in.push_back(&in.vof), cells_out.push_back(&out.vof);
  interpolate(
      cells_of<Dim>(from, every), cells_of<Dim>(to, wanted), static_cast<int>(cells_in.size()),
      [&](int f, int b) { return cells_in[static_cast<std::size_t>(f)]->block(b); },
      [&](int f, int b) { return cells_out[static_cast<std::size_t>(f)]->block(b); });
  if (vof)
    for (double& x : out.vof.data()) x = std::clamp(x, 0.0, 1.0);

  std::vector<const FaceField<double, Dim>*> faces_in;
  std::vector<FaceField<double, Dim>*> faces_out;
  if (is_set(in.u)) faces_in.push_back(&in.u), faces_out.push_back(&out.u);
  if (is_set(in.w)) faces_in.push_back(&in.w), faces_out.push_back(&out.w);
  for (int axis = 0; axis < Dim; ++axis) {
    interpolate(
        faces_of<Dim>(from, axis, every,
                      [&](int b, int side) { return lists_side(from, b, axis, side); }),
        faces_of<Dim>(to, axis, wanted,
                      [&](int b, int side) { return side_is_free(to, pair, all, b, axis, side); }),
        static_cast<int>(faces_in.size()),
        [&](int f, int b) { return faces_in[static_cast<std::size_t>(f)]->block(axis, b); },
        [&](int f, int b) { return faces_out[static_cast<std::size_t>(f)]->block(axis, b); });
    for (FaceField<double, Dim>* f : faces_out) unite_faces(to, all ? nullptr : &pair, axis, *f);
  }
  return report;
}

#define SEAWAY_INSTANTIATE(D)                                                              \
  template PrbfReport prbf_flow<D>(const PrbfOptions&, const Forest<D>&, const Forest<D>&, \
                                   const MeshPair<D>&, bool, const FlowFields<D>&,         \
                                   FlowFields<D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
