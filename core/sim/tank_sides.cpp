#include "core/sim/tank_sides.hpp"

#include <cmath>
#include <utility>

namespace seaway::sim {

namespace {

constexpr double along_axis = 1e-6;  ///< part of a direction that counts as none

std::array<double, 2> direction(const Case& c) { return {std::cos(c.wave.heading), std::sin(c.wave.heading)}; }

}  // namespace

bool is_oblique(const Case& c) {
  const auto [x, y] = direction(c);
  return std::abs(x) > along_axis && std::abs(y) > along_axis;
}

std::array<std::array<TankSide, 2>, 2> tank_sides(const Case& c) {
  std::array<std::array<TankSide, 2>, 2> sides;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double along = direction(c)[axis];
    if (std::abs(along) <= along_axis) continue;
    auto& [lower, upper] = sides[axis];
    lower = {c.zones.generation_length, true};
    upper = {c.zones.absorption_length, false};
    if (along < 0) std::swap(lower, upper);
  }
  return sides;
}

}  // namespace seaway::sim
