// Closed surfaces from STL files, binary and ASCII.
//
// The format names no unit: it has to be given. Equal corners become one vertex (on a
// raster of 1e-7 of the largest extent); triangles that lose their area that way are dropped. The
// stored normals are ignored: the order of the corners counts.
#pragma once

#include <string>

#include "core/hull/surface.hpp"

namespace seaway::hull {

/// `unit`: metres in one unit of the file (1, 0.001, 0.0254 ...). Reads at most 500,000
/// triangles (25 MB); memory follows the file's size, never the number that its head announces.
/// Throws Error, each with what to do: not_found (cannot be opened); invalid_argument: no unit; not
/// an STL file; empty; announces more triangles than it holds; a number that is not finite; size
/// below 1 mm or above 1 km (wrong unit); open; neighbours that look to different sides; normals
/// inwards; triangles that cross.
Surface read_stl(const std::string& file, double unit);

}  // namespace seaway::hull
