// Pictures' raw material: the free surface and the hull at an instant, as a small JSON file (2-D sections).
#pragma once

#include <string>

#include "core/sim/simulation.hpp"

namespace seaway::sim {

/// {"time_s", "stage", "bounds": {"y": [..], "z": [..]}, "surface": [[[y, z], [y, z]], ...],
///  "hull": [[[y, z], ...], ...]}: interface segments of all mixed cells outside the hull, closed loops of the
/// hull's solid. With a turbulence model also {"turbulence": {"y", "z": {first, step, count}, "tke_m2_per_s2",
/// "nu_t_m2_per_s": rows along y from below}}: the cells at the points of a grid about the hull. Written aside and renamed. Throws Error(unavailable) when it cannot be written.
void write_section(Simulation<2>& simulation, int stage, const std::string& path);

}  // namespace seaway::sim
