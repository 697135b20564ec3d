// Physical and mathematical constants.
#pragma once

#include <numbers>

namespace seaway {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180.0;  ///< radians in one degree; only for defaults and text

}  // namespace seaway
