#include "core/io/polygon_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "core/base/error.hpp"
#include "core/io/whole_file.hpp"

namespace seaway::io {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are written as little-endian");

/// The appended block: each array as its length in bytes (64 bit) and its bytes.
class Appended {
 public:
  /// Returns the offset that the array's element names.
  template <class T>
  std::size_t add(const std::vector<T>& values) {
    const std::size_t at = bytes_.size();
    const std::uint64_t count = values.size() * sizeof(T);
    bytes_.resize(at + sizeof count + count);
    std::memcpy(bytes_.data() + at, &count, sizeof count);
    if (count > 0) std::memcpy(bytes_.data() + at + sizeof count, values.data(), count);
    return at;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string array(const char* type, const std::string& name, int components, std::size_t offset) {
  return fmt::format(
      R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", type, name,
      components, offset);
}

}  // namespace

void write_vtp(const PolygonMesh& mesh, const std::string& path) {
  Appended data;
  std::vector<float> points;
  for (const Vec3& x : mesh.points)
    for (int a = 0; a < 3; ++a) points.push_back(static_cast<float>(x[a]));
  std::vector<std::int64_t> corners, ends;
  for (const auto& polygon : mesh.polygons) {
    for (const int i : polygon) {
      if (i < 0 || i >= static_cast<int>(mesh.points.size()))
        fail(ErrorCode::internal, "polygon corner {} of {} points", i, mesh.points.size());
      corners.push_back(i);
    }
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  std::string values;
  for (const auto& [name, numbers] : mesh.values) {
    if (numbers.size() != mesh.points.size())
      fail(ErrorCode::internal, "{} values of {} for {} points", numbers.size(), name, mesh.points.size());
    values += array("Float32", name, 1, data.add(std::vector<float>(numbers.begin(), numbers.end())));
  }
  const std::string text = fmt::format(
      R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PolyData><Piece NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}">
<PointData>{}</PointData>
<Points>{}</Points>
<Polys>{}{}</Polys>
</Piece></PolyData>
<AppendedData encoding="raw">_)",
      mesh.points.size(), mesh.polygons.size(), values, array("Float32", "points", 3, data.add(points)),
      array("Int64", "connectivity", 1, data.add(corners)), array("Int64", "offsets", 1, data.add(ends)));
  write_whole_file(path, {text, data.bytes(), "\n</AppendedData>\n</VTKFile>\n"});
}

}  // namespace seaway::io
