#include "core/motion/rigid_body.hpp"

#include <cmath>

#include "core/base/error.hpp"

namespace seaway::motion {

template <int Dim>
FreeDofs<Dim> free_dofs(std::span<const Dof> free) {
  FreeDofs<Dim> out{};
  for (const Dof dof : free) {
    const int i = dof_index<Dim>(dof);
    SEAWAY_CHECK(i >= 0,
                 "{} cannot be free in a two-dimensional case; allowed are sway, heave, roll",
                 to_string(dof));
    out[i] = true;
  }
  return out;
}

template <int Dim>
RigidBody<Dim> make_rigid_body(double mass, const Vec3& cog_in_hull, const Vec3& gyradii) {
  SEAWAY_CHECK(std::isfinite(mass) && mass > 0, "body mass is {}; it must be greater than 0", mass);
  SEAWAY_CHECK(cog_in_hull.allFinite(), "the centre of gravity ({}, {}, {}) must be finite",
               cog_in_hull.x(), cog_in_hull.y(), cog_in_hull.z());
  RigidBody<Dim> body;
  body.mass = mass;
  body.cog = from_vec3<Dim>(cog_in_hull);
  for (int i = 0; i < n_angular<Dim>; ++i) {
    SEAWAY_CHECK(std::isfinite(gyradii[i]) && gyradii[i] > 0,
                 "radius of gyration about {} is {}; it must be greater than 0", "xyz"[i],
                 gyradii[i]);
    body.inertia(i, i) = mass * gyradii[i] * gyradii[i];
  }
  if constexpr (Dim == 3) {
    // Ixx + Iyy >= Izz and so on; thin bodies reach equality, hence the margin for rounding.
    for (int i = 0; i < 3; ++i) {
      const double own = body.inertia(i, i);
      SEAWAY_CHECK(
          own <= (body.inertia.trace() - own) * (1 + 1e-9),
          "radii of gyration ({}, {}, {}) are impossible: the square about {} exceeds the sum "
          "of the other two",
          gyradii.x(), gyradii.y(), gyradii.z(), "xyz"[i]);
    }
  }
  return body;
}

template <int Dim>
typename RigidBody<Dim>::Inertia earth_inertia(const RigidBody<Dim>& body, const Pose<Dim>& pose) {
  if constexpr (Dim == 2) {
    return body.inertia;
  } else {
    const Rotation<3> r = rotation(pose);
    const Eigen::Matrix3d turned = r * body.inertia * r.transpose();
    return 0.5 * (turned + turned.transpose());  // symmetric to the last bit
  }
}

template <int Dim>
DofMatrix<Dim> mass_matrix(const RigidBody<Dim>& body, const Pose<Dim>& pose) {
  DofMatrix<Dim> m = DofMatrix<Dim>::Zero();
  for (int i = 0; i < Dim; ++i) m(i, i) = body.mass;
  m.template bottomRightCorner<n_angular<Dim>, n_angular<Dim>>() = earth_inertia(body, pose);
  return m;
}

// About the cog M is block diagonal, so only the rotations couple. In their block the rows and
// columns that are not free are emptied but for the diagonal; what its inverse has in the free ones
// is (S^T I S)^-1.
template <int Dim>
DofMatrix<Dim> effective_inverse_mass(const RigidBody<Dim>& body, const Pose<Dim>& pose,
                                      const FreeDofs<Dim>& free) {
  DofMatrix<Dim> out = DofMatrix<Dim>::Zero();
  for (int i = 0; i < Dim; ++i) out(i, i) = free[i] ? 1 / body.mass : 0;
  constexpr int n = n_angular<Dim>;
  typename RigidBody<Dim>::Inertia block = earth_inertia(body, pose);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (i != j && !(free[Dim + i] && free[Dim + j])) block(i, j) = 0;
    }
  }
  const typename RigidBody<Dim>::Inertia inverse = block.inverse();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (free[Dim + i] && free[Dim + j]) {
        out(Dim + i, Dim + j) = 0.5 * (inverse(i, j) + inverse(j, i));
      }
    }
  }
  return out;
}

template <int Dim>
DofVector<Dim> gyroscopic_load(const RigidBody<Dim>& body, const Pose<Dim>& pose,
                               const Twist<Dim>& twist) {
  DofVector<Dim> load = DofVector<Dim>::Zero();
  if constexpr (Dim == 3) {
    const Vec3 omega = twist.template tail<3>();
    const Vec3 momentum = earth_inertia(body, pose) * omega;
    load.template tail<3>() = -omega.cross(momentum);
  }
  return load;
}

template <int Dim>
Twist<Dim> keep_momentum(const RigidBody<Dim>& body, const Pose<Dim>& old_pose,
                         const Pose<Dim>& new_pose, const Twist<Dim>& twist,
                         const FreeDofs<Dim>& free) {
  if constexpr (Dim == 2) {
    return twist;
  } else {
    const DofVector<3> lost = (mass_matrix(body, old_pose) - mass_matrix(body, new_pose)) * twist;
    return twist + effective_inverse_mass(body, new_pose, free) * lost;
  }
}

template <int Dim>
double kinetic_energy(const RigidBody<Dim>& body, const Pose<Dim>& pose, const Twist<Dim>& twist) {
  return 0.5 * twist.dot(mass_matrix(body, pose) * twist);
}

#define SEAWAY_INSTANTIATE(Dim)                                                                 \
  template FreeDofs<Dim> free_dofs<Dim>(std::span<const Dof>);                                  \
  template RigidBody<Dim> make_rigid_body<Dim>(double, const Vec3&, const Vec3&);               \
  template RigidBody<Dim>::Inertia earth_inertia<Dim>(const RigidBody<Dim>&, const Pose<Dim>&); \
  template DofMatrix<Dim> mass_matrix<Dim>(const RigidBody<Dim>&, const Pose<Dim>&);            \
  template DofMatrix<Dim> effective_inverse_mass<Dim>(const RigidBody<Dim>&, const Pose<Dim>&,  \
                                                      const FreeDofs<Dim>&);                    \
  template DofVector<Dim> gyroscopic_load<Dim>(const RigidBody<Dim>&, const Pose<Dim>&,         \
                                               const Twist<Dim>&);                              \
  template Twist<Dim> keep_momentum<Dim>(const RigidBody<Dim>&, const Pose<Dim>&,               \
                                         const Pose<Dim>&, const Twist<Dim>&,                   \
                                         const FreeDofs<Dim>&);                                 \
  template double kinetic_energy<Dim>(const RigidBody<Dim>&, const Pose<Dim>&, const Twist<Dim>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)
#undef SEAWAY_INSTANTIATE

}  // namespace seaway::motion
