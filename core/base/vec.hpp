// Small vectors. `Vec<Dim>` holds the axes that a Dim-dimensional run has: Dim 2 is the y-z plane
// (component 0 = y, 1 = z), Dim 3 is x, y, z. Gravity acts on the last axis. `Vec3` is always x, y, z.
#pragma once

#include <Eigen/Core>
#include <array>

namespace seaway {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

template <int Dim>
using IVec = std::array<int, Dim>;

/// The axes of the run out of (x, y, z): (y, z) in 2-D.
template <int Dim>
Vec<Dim> from_vec3(const Vec3& v) {
  return v.template tail<Dim>();
}

/// Back to (x, y, z), with x = 0 in 2-D.
template <int Dim>
Vec3 to_vec3(const Vec<Dim>& v) {
  Vec3 out = Vec3::Zero();
  out.template tail<Dim>() = v;
  return out;
}

}  // namespace seaway
