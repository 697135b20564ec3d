// Which of the tank's vertical sides let waves in and which let them out. Pure functions.
#pragma once

#include <array>

#include "core/sim/case.hpp"

namespace seaway::sim {

struct TankSide {
  double zone = 0;        ///< length of the zone at this side, inwards [m]; 0: a plain wall
  bool incoming = false;  ///< generation, otherwise absorption
};

/// By axis x, y, then lower and upper side. Along the axes that a wave has a part of: generation where it comes from,
/// absorption where it goes to. In calm water both lie along `heading` as well.
std::array<std::array<TankSide, 2>, 2> tank_sides(const Case& c);

/// Whether waves go along neither x nor y: all four sides have zones then.
bool is_oblique(const Case& c);

}  // namespace seaway::sim
