// From one stage's mesh to the next: all fields of a flow, with the report that goes into the stage result.
//
//   vof     cut by the coarse interface planes (core/transfer/split_vof.hpp), or interpolated and limited
//   u, w    face velocities: parts of a coarse face keep its flux, faces inside coarse cells are interpolated
//   p       interpolated without limiter away from the interface, limited where its gradient jumps; near the
//           interface the first pressure solve is to correct it
//   extra   interpolated, children's mean = coarse value, inside the values of the stencil (so a positive
//           field stays positive)
//
// Kept leaves are copied bit by bit (cells, and faces between two kept leaves of one size); leaves that
// replace finer ones get means. Refinement by several levels is done level by level.
//
// The mapped w is not divergence-free inside refined cells: the net flux through every coarse cell is what
// it was, but the faces inside it are interpolated. A projection that frees the faces between two refined
// cells (MapReport::origin) and fixes all others is solvable and makes it so.
#pragma once

#include <string>

#include "core/transfer/flow_fields.hpp"
#include "core/transfer/mesh_pair.hpp"
#include "core/transfer/prbf.hpp"

namespace seaway::transfer {

enum class MapMethod {
  local_rbf,  ///< stencils of core/transfer/local_rbf.hpp
  linear,     ///< the baseline, core/transfer/linear.hpp
  prbf,       ///< the published method, core/transfer/prbf_flow.hpp; for comparison
};

enum class VofMethod {
  split,    ///< cut the coarse interface planes; for a sharp interface
  bounded,  ///< interpolate within 0..1; for a smeared one. Conserves the water but for prbf, which clips
};

struct MapOptions {
  MapMethod method = MapMethod::local_rbf;
  VofMethod vof = VofMethod::split;
  int degree = 1;              ///< local_rbf: tail degree; 2 needs radius 2 to hold next to the tank's sides
  int radius = 1;              ///< local_rbf: 1: 3^Dim points, 2: 5^Dim (smoother data; reaches across walls)
  double lebesgue_limit = 6;   ///< local_rbf: largest sum of |weights|; beyond it the degree is lowered
  bool limit_velocity = true;  ///< keep new velocities within the values of their stencil
  PrbfOptions prbf;            ///< method prbf only
};

struct MapReport {
  std::string method;
  double cpu_s = 0;                                     ///< all threads of the process
  double vof_min = 0, vof_max = 0;                      ///< on the new mesh
  double water_before = 0, water_after = 0;             ///< [m3] or [m2], compensated sums
  double divergence_before = 0, divergence_after = 0;   ///< max |sum of face fluxes of w| / volume [1/s]
  std::int64_t kept_cells = 0, new_cells = 0;           ///< new: refined and coarsened
  std::int64_t refined_cells = 0, coarsened_cells = 0;
  std::int64_t fall_backs = 0;                          ///< stencils that dropped to a simpler rule (prbf:
                                                        ///< subsets that were degenerate or indefinite)
  double lebesgue = 1;                                  ///< largest sum of |weights| of a cell stencil
  std::vector<char> origin;  ///< Origin of every cell, laid out as a cell field over the new forest;
                             ///< parents' cells are 0
};

/// Maps all fields that are set in `in` (a default-constructed field is skipped). `out`, another object, is
/// overwritten with fields over `to`, restricted to the parents that kernels read. `in` needs no restricted
/// parents. With prbf and evaluate_all no cell counts as kept. Throws Error(invalid_argument) for forests of
/// different tanks or options out of range, Error(resource_exhausted) when prbf would need too much memory.
template <int Dim>
MapReport map_flow(const MapOptions& options, const Forest<Dim>& from, const Forest<Dim>& to,
                   const FlowFields<Dim>& in, FlowFields<Dim>& out);

/// Sum of field x cell volume over the leaves, compensated [neumaier1974].
template <int Dim>
double volume_integral(const Forest<Dim>& forest, const CellField<double, Dim>& f);

/// Largest |sum of face fluxes| / volume over the leaves [1/s].
template <int Dim>
double max_divergence(const Forest<Dim>& forest, const FaceField<double, Dim>& w);

}  // namespace seaway::transfer
