#include "core/hull/surface_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/section_shape.hpp"

namespace seaway::hull {

namespace {

void check_length(const char* what, double value) {
  SEAWAY_CHECK(std::isfinite(value) && value > 0 && value < 1e6,
               "{} is {}; it must be a positive length in metres", what, value);
}

/// Prism along x. The section runs anticlockwise in (y, z) and is star-shaped about `middle`.
Surface prism(double length, const Polygon& section, const Vec2& middle) {
  SurfaceBuilder out;
  const double x = 0.5 * length;
  const auto at = [](double along, const Vec2& p) { return Vec3(along, p.x(), p.y()); };
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Vec2 &p = section[i], &q = section[(i + 1) % section.size()];
    out.quad(at(-x, p), at(-x, q), at(x, q), at(x, p));
    out.triangle(at(x, middle), at(x, p), at(x, q));
    out.triangle(at(-x, middle), at(-x, q), at(-x, p));
  }
  return out.take();
}

}  // namespace

Surface box_surface(double length, double beam, double height) {
  check_length("length", length);
  check_length("beam", beam);
  check_length("height", height);
  Surface s;
  for (int i = 0; i < 8; ++i)
    s.vertices.emplace_back((i & 1 ? 0.5 : -0.5) * length, (i & 2 ? 0.5 : -0.5) * beam,
                            i & 4 ? height : 0.0);
  s.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return s;
}

Surface rounded_box_surface(double length, double beam, double height, double radius) {
  check_length("length", length);
  SectionSpec spec;
  spec.shape = SectionSpec::Shape::rounded_box;
  spec.beam = beam;
  spec.height = height;
  spec.corner_radius = radius;
  return prism(length, outer_polygon(spec), {0.0, 0.5 * height});
}

Surface cylinder_surface(double length, double radius, int n_around) {
  check_length("length", length);
  check_length("radius", radius);
  SEAWAY_CHECK(n_around >= 8 && n_around <= 10000, "{} facets around; allowed: 8 to 10000",
               n_around);
  const double r = radius * std::sqrt(pi / (0.5 * n_around * std::sin(2 * pi / n_around)));
  Polygon circle;
  for (int i = 0; i < n_around; ++i) {
    const double angle = 2 * pi * (i + 0.5) / n_around;
    circle.emplace_back(r * std::cos(angle), radius + r * std::sin(angle));
  }
  return prism(length, circle, {0.0, radius});
}

Surface sphere_surface(double radius, int n) {
  check_length("radius", radius);
  SEAWAY_CHECK(n >= 8 && n <= 2000, "{} facets from pole to pole; allowed: 8 to 2000", n);
  SurfaceBuilder out;
  const auto at = [&](int i, int j) {  // i: from the lower pole, j: around
    if (i == 0 || i == n) return Vec3(0, 0, i == 0 ? -radius : radius);
    const double up = pi * i / n, around = pi * (j % (2 * n)) / n;
    return Vec3(radius * std::sin(up) * std::cos(around), radius * std::sin(up) * std::sin(around),
                -radius * std::cos(up));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j)
      out.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
  Surface s = out.take();
  const double grow = std::cbrt(4.0 / 3.0 * pi * radius * radius * radius / enclosed_volume(s));
  return transformed(s, grow, Eigen::Matrix3d::Identity(), Vec3(0, 0, radius));
}

Surface wigley_surface(double length, double beam, double draft, double height, int n_x, int n_z) {
  check_length("length", length);
  check_length("beam", beam);
  check_length("draft", draft);
  SEAWAY_CHECK(std::isfinite(height) && height > draft * (1 + 1e-6) && height < 1e6,
               "height is {} m; it must lie above the draft, {} m", height, draft);
  SEAWAY_CHECK(n_x >= 4 && n_x <= 5000 && n_z >= 2 && n_z <= 5000,
               "{} columns and {} rows; allowed: 4 to 5000 and 2 to 5000", n_x, n_z);
  const double step = draft / n_z;
  const int n_above = std::max(1, static_cast<int>(std::lround((height - draft) / step)));
  const auto at = [&](int i, int j) {
    const double s = 2.0 * i / n_x - 1;
    const double z = j <= n_z ? step * j : draft + (height - draft) * (j - n_z) / n_above;
    const double down = std::min(z / draft, 1.0) - 1;
    const double y =
        i == 0 || i == n_x || j == 0 ? 0 : 0.5 * beam * (1 - s * s) * (1 - down * down);
    return Vec3(0.5 * length * s, y, z);
  };
  SurfaceBuilder out;
  for (int i = 0; i < n_x; ++i) {
    for (int j = 0; j < n_z + n_above; ++j)
      out.mirrored_quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    const auto deck = [&](int column, int part) {  // from starboard to port in four strips
      Vec3 x = at(column, n_z + n_above);
      x.y() *= 0.5 * part - 1;
      return x;
    };
    for (int k = 0; k < 4; ++k)
      out.quad(deck(i, k), deck(i + 1, k), deck(i + 1, k + 1), deck(i, k + 1));
  }
  return out.take();
}

}  // namespace seaway::hull
