// Generation and absorption of waves at the tank's vertical sides: relaxation towards a wave or towards rest. Velocities
// are relaxed before the projection, implicitly; the volume fraction towards the wave's cell-integrated water
// volume. The water that the zones add is kept in a book. Air is left alone.
#pragma once

#include <memory>

#include "core/flow/flow_state.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::flow {

struct ZoneSpec {
  double length = 0;      ///< from the tank's side inwards [m]; 0: none
  bool to_wave = false;   ///< otherwise towards rest (velocity only: exactly conservative)
};

/// By horizontal axis, then lower and upper side.
template <int Dim>
using SideZones = std::array<std::array<ZoneSpec, 2>, Dim - 1>;

template <int Dim>
class WaveZones {
 public:
  /// `rate`: relaxation at the tank's side [1/s], falling with the square of the distance to the zone's inner edge; where zones
  /// of two sides overlap the stronger one counts. `wave` may be null (then all zones relax to rest).
  WaveZones(const Forest<Dim>& forest, std::shared_ptr<const waves::WaveField> wave, const SideZones<Dim>& sides, double rate);

  /// Whether the side's boundary faces carry the wave's velocity.
  bool drives(int axis, int side) const {
    return axis + 1 < Dim && wave_ != nullptr && sides_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)].to_wave;
  }
  /// Whether water may come in through sides across the axis.
  bool drives(int axis) const { return drives(axis, 0) || drives(axis, 1); }

  /// vof towards the wave at time t; returns the water added [m^Dim].
  double relax_vof(CellField<double, Dim>& vof, double t, double dt) const;
  /// u towards the wave at time t (u lives half a step after the positions), weighted with the water
  /// fraction; sets the boundary faces of driven sides.
  void relax_velocity(FlowState<Dim>& state, double t, double dt) const;

  /// A cell scalar towards a value in the zones towards a wave.
  void relax_scalar(CellField<double, Dim>& f, double value, double dt) const;

  /// Leaves that touch a zone. Water flux in through the driven sides over dt is part of the book as well: added by the caller.
  const std::vector<int>& blocks() const { return blocks_; }

 private:
  struct Pull {
    double rate = 0;       ///< [1/s]
    bool to_wave = false;
  };
  Pull pull_at(const Vec<Dim>& x) const;
  bool has_zones(int axis) const;
  const Forest<Dim>& forest_;
  std::shared_ptr<const waves::WaveField> wave_;
  SideZones<Dim> sides_;
  double rate_;
  std::vector<int> blocks_;
};

extern template class WaveZones<2>;
extern template class WaveZones<3>;

}  // namespace seaway::flow
