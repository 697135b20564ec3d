// Values inside the hull that make the flow outside well-balanced: the interface goes straight on through the
// wall, the velocity slips along it. Works on window arrays (core/flow/hull_window.hpp).
//
// A cell with less than half fluid, or a closed face, is "unknown" and gets its value from known neighbours
// that it can see: those on the fluid side of it, (x_n - x_c) . grad(phi) > 0.3 h. Without that rule a rotated
// wall of two cells leaks through diagonal neighbours. With Walls::thin nothing passes between spaces.
#pragma once

#include <span>

#include "core/flow/flow_state.hpp"
#include "core/flow/hull_mask.hpp"

namespace seaway::flow {

/// Layers of cells and faces filled inside the hull.
inline constexpr int extension_layers = 4;

template <int Dim>
class HullExtension {
 public:
  /// Overwrites vof (window array) in cells with fluid_fraction < 1/2: first layer from the interface planes
  /// of mixed neighbours evaluated there, deeper layers from means.
  void extend_vof(const HullMask<Dim>& mask, std::vector<double>& vof);

  /// Overwrites scalars (window arrays) in cells with fluid_fraction < 1/2 by means of the cells around them that
  /// lie in the fluid (zero gradient); deeper than the layers: `deep`.
  void extend_scalars(const HullMask<Dim>& mask, std::array<std::vector<double>*, 2> scalars,
                      std::array<double, 2> deep);

  /// Overwrites u (window array of the axis) in closed faces; deeper than the layers: the wall's velocity.
  /// Nearly closed faces (aperture < 0.2) keep their value within the spread of their neighbours.
  void extend_velocity(const HullMask<Dim>& mask, int axis, const motion::Twist<Dim>& twist,
                       std::vector<double>& u);

 private:
  template <class Behind>
  void fill_layers(const HullWindow<Dim>& window, const std::vector<double>& phi, const Behind& behind,
                   std::span<std::vector<double>* const> fields);
  template <class Behind>
  void level_off(const HullWindow<Dim>& window, const Behind& behind, std::vector<double>& vof);

  std::vector<signed char> layer_, face_space_;
  std::vector<char> level_;  ///< cells that know the water at their own height: in the fluid, or reached along a row
  std::vector<double> next_;
  std::vector<int> front_, deeper_, list_;
};

extern template class HullExtension<2>;
extern template class HullExtension<3>;

}  // namespace seaway::flow
