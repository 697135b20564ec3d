// The book of the water at the hull. Volume fractions of cut cells are fractions of the full cell and move with
// the mixture velocity, so the water that is really there (below the interface and outside the hull, "visible")
// drifts. Each step the book says how much visible water every cell at the hull must have,
//
//   V' = V - sum_f s_f phi_f A dt (w_f - (1 - s_open_f) v_s . n),
//
// phi_f the water fraction of what passed through the face, s_open_f the open part of the face itself. What a
// cell has too much or too little is taken from or given to mixed cells near it, in the same connected space;
// the rest goes to a reservoir of the space, released at a rate. Conservative to rounding.
#pragma once

#include <map>
#include <unordered_map>

#include "core/flow/flow_state.hpp"
#include "core/flow/hull_mask.hpp"

namespace seaway::flow {

template <int Dim>
class VolumeBook {
 public:
  /// Start of a run or stage: visible water is measured, nothing is owed.
  void restart(const HullMask<Dim>& mask, const std::vector<double>& vof);
  /// Before the advection of a step: remembers w on the window and clears the fluxes.
  void begin_step(const HullMask<Dim>& mask, const FlowState<Dim>& state);
  /// After each advection sweep: water swept through the faces of an axis [m].
  void add_fluxes(const HullMask<Dim>& mask, int axis, const FaceField<double, Dim>& swept);
  /// After the last sweep, with the hull still where it was: what each cell at the hull must hold.
  /// `twist` is the one in w, `dt` the whole step.
  void close_fluxes(const HullMask<Dim>& mask, const CellField<double, Dim>& vof,
                    const motion::Twist<Dim>& twist, double dt);
  /// After close_fluxes: whether the book says what this cell (HullWindow::global_cell) must hold.
  bool holds(std::int64_t cell) const { return book_.contains(cell); }
  /// Walls::thin, after close_fluxes: a wall that moves through the mesh has carried the other space's volume
  /// fractions into the cells beside it; takes that back (the book has the water).
  void undo_wall_fluxes(const HullMask<Dim>& mask, CellField<double, Dim>& vof, double dt);
  /// With the new geometry: moves water so that the book holds. `advected` is vof before the extension into
  /// the hull, `vof` after it; both window arrays. Changes wholly fluid mixed cells only.
  void settle(const HullMask<Dim>& mask, const std::vector<double>& advected, std::vector<double>& vof,
              double dt, bool correct);

  /// Visible water by window entry [m^Dim]: below the interface and outside the hull.
  const std::vector<double>& visible() const { return visible_; }
  /// Water owed to the flow, by space (0 sea, 1 + compartment) [m^Dim].
  std::map<int, double>& reservoirs() { return reservoir_; }
  const std::map<int, double>& reservoirs() const { return reservoir_; }
  double reservoir_total() const;
  /// Sum of |defects| of the last step [m^Dim].
  double last_defect() const { return last_defect_; }

 private:
  double visible_in(const HullMask<Dim>& mask, const IVec<Dim>& i, const std::vector<double>& vof) const;
  void measure(const HullMask<Dim>& mask, const std::vector<double>& vof);
  int space_of(const HullMask<Dim>& mask, const IVec<Dim>& i) const;
  double give(const HullMask<Dim>& mask, const IVec<Dim>& i, int space, double defect, std::vector<double>& vof) const;
  void release(const HullMask<Dim>& mask, std::vector<double>& vof, double dt);

  std::vector<double> visible_;
  std::array<std::vector<double>, Dim> w_, swept_;
  std::vector<double> loaded_;
  struct Entry {
    double volume = 0;  ///< [m^Dim]
    int space = -1;     ///< Walls::thin: of the cell when the book was closed
  };
  std::unordered_map<std::int64_t, Entry> book_;  ///< by global cell; only looked up, never iterated
  std::vector<double> start_vof_;                 ///< Walls::thin: window, before the step's advection
  std::map<int, double> reservoir_;
  double last_defect_ = 0;
};

extern template class VolumeBook<2>;
extern template class VolumeBook<3>;

}  // namespace seaway::flow
