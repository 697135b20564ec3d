// What the pictures of a ship's run are made of: the free surface in space, from above and in sections across
// the ship, at an instant. The last two are small JSON files that clients draw; the first is for ParaView.
// Every file is written aside and renamed; all throw Error(unavailable) if it cannot be written.
#pragma once

#include <string>

#include "core/io/polygon_file.hpp"
#include "core/sim/simulation.hpp"

namespace seaway::sim {

/// The interface of every mixed cell outside the hull's solid, one polygon a cell, in earth axes; the value
/// "elevation" is z [m].
io::PolygonMesh free_surface(Simulation<3>& simulation);

/// The hull's surfaces where they are now, in earth axes. Before: the run has a hull out of surfaces.
io::PolygonMesh hull_mesh(const Simulation<3>& simulation);

/// {"time_s", "stage", "x_m", "bounds": {"y": [..], "z": [..]}, "surface": [[[y, z], [y, z]], ...],
///  "hull": [[[y, z], ...], ...]}: the plane x = `x` of the earth axes, as write_section of a 2-D run has it.
void write_section(Simulation<3>& simulation, double x, int stage, const std::string& path);

/// {"time_s", "stage", "x": {"first", "step", "count"}, "y": {...}, "elevation_mm": [row of y 0, ...],
///  "waterline": [[[x, y], ...], ...]}: heights at the middles of squares seen from above, at most about
/// `squares` of them; null where the hull is in the way. "waterline": the hull cut at z = 0.
void write_plan(Simulation<3>& simulation, int stage, int squares, const std::string& path);

}  // namespace seaway::sim
