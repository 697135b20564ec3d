#include "core/hull/space_map.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::hull {

namespace {
constexpr double most_cells = 4e6;
constexpr int brick = 8;
}  // namespace

SpaceMap::SpaceMap(const Box<3>& box, double spacing, const Common& common)
    : box_(box), spacing_(std::max(spacing, std::cbrt((box.upper - box.lower).cwiseMax(0.0).prod() / most_cells))) {
  for (int a = 0; a < 3; ++a)
    n_[a] = std::max(0, static_cast<int>(std::ceil((box.upper[a] - box.lower[a]) / spacing_)));
  spaces_.assign(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]), unknown);
  for (int k = 0; k < n_[2]; k += brick)
    for (int j = 0; j < n_[1]; j += brick)
      for (int i = 0; i < n_[0]; i += brick) fill({i, j, k}, brick, common);
}

/// A brick of size^3 cells, or its eight parts.
void SpaceMap::fill(const IVec<3>& first, int size, const Common& common) {
  for (int a = 0; a < 3; ++a)
    if (first[a] >= n_[a]) return;
  const double half = 0.5 * size * spacing_;
  const Vec3 middle = box_.lower + spacing_ * Vec3(first[0], first[1], first[2]) + Vec3::Constant(half);
  const int space = common(middle, 1.001 * std::sqrt(3.0) * half);
  if (space == unknown) {
    if (size == 1) return;
    const int part = size / 2;
    for (int c = 0; c < 8; ++c)
      fill({first[0] + (c & 1) * part, first[1] + ((c >> 1) & 1) * part, first[2] + (c >> 2) * part}, part, common);
    return;
  }
  for (int k = first[2]; k < std::min(first[2] + size, n_[2]); ++k)
    for (int j = first[1]; j < std::min(first[1] + size, n_[1]); ++j) {
      signed char* row = &spaces_[static_cast<std::size_t>((k * n_[1] + j) * n_[0])];
      std::fill(row + first[0], row + std::min(first[0] + size, n_[0]), static_cast<signed char>(space));
    }
}

int SpaceMap::at(const Vec3& x) const {
  IVec<3> i{};
  for (int a = 0; a < 3; ++a) {
    const double u = (x[a] - box_.lower[a]) / spacing_;
    if (!(u >= 0 && u < n_[a])) return unknown;
    i[a] = static_cast<int>(u);
  }
  return spaces_[static_cast<std::size_t>((i[2] * n_[1] + i[1]) * n_[0] + i[0])];
}

}  // namespace seaway::hull
