// Polygons in space with values at their corners, as a file for ParaView (VTK XML PolyData, .vtp: one raw
// appended block, 32-bit floats). Written aside and renamed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/vec.hpp"

namespace seaway::io {

struct PolygonMesh {
  std::vector<Vec3> points;                           ///< [m]
  std::vector<std::vector<int>> polygons;             ///< corners in order, indices of points
  std::map<std::string, std::vector<double>> values;  ///< by name: one number a point
};

/// Throws Error(unavailable) if the file cannot be written, Error(internal) if a value list has another
/// length than the points or a corner does not exist.
void write_vtp(const PolygonMesh& mesh, const std::string& path);

}  // namespace seaway::io
