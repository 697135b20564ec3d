// Generation and absorption of waves at the tank's ends: relaxation towards a wave or towards rest. Velocities
// are relaxed before the projection, implicitly; the volume fraction towards the wave's cell-integrated water
// volume. The water that the zones add is kept in a book. Air is left alone.
#pragma once

#include <memory>

#include "core/flow/flow_state.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::flow {

struct ZoneSpec {
  double length = 0;      ///< from the tank's end inwards [m]; 0: none
  bool to_wave = false;   ///< otherwise towards rest (velocity only: exactly conservative)
};

template <int Dim>
class WaveZones {
 public:
  /// `axis`: along which the zones lie; `rate`: relaxation at the tank's end [1/s], falling with the square
  /// of the distance to the zone's inner edge. `wave` may be null (then all zones relax to rest).
  WaveZones(const Forest<Dim>& forest, std::shared_ptr<const waves::WaveField> wave, int axis,
            const ZoneSpec& lower, const ZoneSpec& upper, double rate);

  /// Whether the end's boundary faces carry the wave's velocity.
  bool drives(int side) const { return spec_[static_cast<std::size_t>(side)].to_wave && wave_ != nullptr; }
  int axis() const { return axis_; }

  /// vof towards the wave at time t; returns the water added [m^Dim].
  double relax_vof(CellField<double, Dim>& vof, double t, double dt) const;
  /// u towards the wave at time t (u lives half a step after the positions), weighted with the water
  /// fraction; sets the boundary faces of driven ends.
  void relax_velocity(FlowState<Dim>& state, double t, double dt) const;

  /// A cell scalar towards a value in the zones towards a wave.
  void relax_scalar(CellField<double, Dim>& f, double value, double dt) const;

  /// Water flux in through the driven ends over dt is part of the book as well: added by the caller.
  const std::vector<int>& blocks() const { return blocks_; }

 private:
  double gamma(double s) const;
  bool towards_wave(double s) const;
  const Forest<Dim>& forest_;
  std::shared_ptr<const waves::WaveField> wave_;
  int axis_;
  std::array<ZoneSpec, 2> spec_;
  double rate_;
  double begin_, end_;        ///< tank ends along the axis
  std::vector<int> blocks_;   ///< leaves that touch a zone
};

extern template class WaveZones<2>;
extern template class WaveZones<3>;

}  // namespace seaway::flow
