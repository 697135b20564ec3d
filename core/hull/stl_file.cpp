#include "core/hull/stl_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/base/error.hpp"
#include "core/hull/boolean3.hpp"

namespace seaway::hull {

namespace {

constexpr std::uint64_t most_triangles = 500'000;

using Corners = std::vector<std::array<Vec3, 3>>;

Corners read_binary(const std::string& file, std::ifstream& in, std::uint64_t n_bytes,
                    std::uint32_t announced) {
  const std::uint64_t there = (n_bytes - 84) / 50;
  SEAWAY_CHECK(announced <= there,
               "{}: its head announces {} triangles, but the file holds only {}; it is damaged or "
               "cut short: export it again",
               file, announced, there);
  SEAWAY_CHECK(announced > 0, "{}: it holds no triangles; export the hull again", file);
  SEAWAY_CHECK(announced <= most_triangles,
               "{}: {} triangles; at most {} are read: make the surface coarser", file, announced,
               most_triangles);
  Corners triangles;
  triangles.reserve(announced);
  char record[50];
  for (std::uint32_t i = 0; i < announced && in.read(record, sizeof record); ++i) {
    float x[9];
    std::memcpy(x, record + 12, sizeof x);
    triangles.push_back({Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5]), Vec3(x[6], x[7], x[8])});
  }
  SEAWAY_CHECK(triangles.size() == announced, "{}: reading stopped after {} of {} triangles", file,
               triangles.size(), announced);
  return triangles;
}

Corners read_ascii(const std::string& file, std::ifstream& in) {
  Corners triangles;
  std::array<Vec3, 3> now;
  int n = 0;
  std::string word;
  while (in >> word) {
    if (word != "vertex") {
      if (word == "endfacet") {
        SEAWAY_CHECK(n == 3, "{}: facet {} has {} corners; STL facets have 3", file,
                     triangles.size(), n);
        triangles.push_back(now);
        n = 0;
        SEAWAY_CHECK(triangles.size() <= most_triangles,
                     "{}: more than {} triangles: make the surface coarser", file, most_triangles);
      }
      continue;
    }
    SEAWAY_CHECK(n < 3, "{}: facet {} has more than 3 corners", file, triangles.size());
    for (int a = 0; a < 3; ++a) {
      in >> word;
      char* end = nullptr;
      now[static_cast<std::size_t>(n)][a] = std::strtod(word.c_str(), &end);
      SEAWAY_CHECK(in && *end == '\0' && end != word.c_str(),
                   "{}: '{}' in facet {} is not a number", file, word, triangles.size());
    }
    ++n;
  }
  SEAWAY_CHECK(n == 0, "{}: it ends inside facet {}; export it again", file, triangles.size());
  SEAWAY_CHECK(!triangles.empty(), "{}: it holds no triangles; is it an STL file?", file);
  return triangles;
}

Corners read_triangles(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(ErrorCode::not_found, "STL file '{}' cannot be opened; check the path", file);
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  SEAWAY_CHECK(in && end > 0, "{}: it is empty or no regular file; export the hull again", file);
  const auto n_bytes = static_cast<std::uint64_t>(end);
  in.seekg(0);
  char head[84] = {};
  in.read(head, static_cast<std::streamsize>(std::min<std::uint64_t>(84, n_bytes)));
  std::uint32_t announced = 0;
  std::memcpy(&announced, head + 80, sizeof announced);
  // Binary files may also begin with "solid": their size tells, and a text has no zero bytes.
  const bool says_solid = std::strncmp(head, "solid", 5) == 0;
  const bool fits = n_bytes >= 84 && n_bytes == 84 + 50 * static_cast<std::uint64_t>(announced);
  const bool has_zero = std::find(head, head + std::min<std::uint64_t>(84, n_bytes), '\0') !=
                        head + std::min<std::uint64_t>(84, n_bytes);
  in.clear();
  if (says_solid && !fits && !has_zero) {
    in.seekg(0);
    return read_ascii(file, in);
  }
  SEAWAY_CHECK(n_bytes >= 84, "{}: {} bytes are too few for an STL file; export the hull again",
               file, n_bytes);
  in.seekg(84);
  return read_binary(file, in, n_bytes, announced);
}

}  // namespace

Surface read_stl(const std::string& file, double unit) {
  SEAWAY_CHECK(std::isfinite(unit) && unit > 0,
               "the unit of {} is not given (or not positive: {}); an STL file does not say it: "
               "give the metres in one unit, for example 0.001 for millimetres",
               file, unit);
  Corners triangles = read_triangles(file);
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (Vec3& x : triangles[i]) {
      SEAWAY_CHECK(x.allFinite(),
                   "{}: facet {} has a coordinate that is not a finite number; "
                   "repair the file where it was made",
                   file, i);
      x *= unit;
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  const Vec3 extent = high - low;
  const double size = extent.maxCoeff();
  SEAWAY_CHECK(
      size > 1e-3 && size < 1e3,
      "{}: with a unit of {} m the hull is {:.4g} x {:.4g} x {:.4g} m; allowed: 1 mm to 1 km. "
      "Check the unit",
      file, unit, extent.x(), extent.y(), extent.z());
  SurfaceBuilder builder(1e-7 * size);
  for (const auto& t : triangles) builder.triangle(t[0], t[1], t[2]);
  Surface s = builder.take();
  const auto problems = find_surface_problems(s);
  if (!problems.empty())
    fail(ErrorCode::invalid_argument, "{}: {}; {}", file, problems[0].message, problems[0].hint);
  if (const auto crossing = first_crossing(s)) {
    const Vec3 at = s.vertices[s.triangles[crossing->first][0]] / unit;
    fail(ErrorCode::invalid_argument,
         "{}: triangles cross each other, the first near ({:.4g}, {:.4g}, {:.4g}) in the file's "
         "unit; make one outer surface of all parts (union) where it was made",
         file, at.x(), at.y(), at.z());
  }
  return s;
}

}  // namespace seaway::hull
