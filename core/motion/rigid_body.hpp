// Mass, inertia and free directions of a rigid body, as the pressure solve needs them.
//
// The equations of motion about the cog in earth axes are M dV/dt = F - (0, omega x (I omega)) with
// M = diag(m, I), I = R I_body R^T. With some directions held the acceleration is S (S^T M S)^-1
// S^T F, S = columns of the free directions: deleting rows of M^-1 instead is wrong where inertia
// couples free and held rotations.
//
// In a section mass and inertia are per metre [kg/m, kg m].
#pragma once

#include <array>
#include <initializer_list>
#include <span>

#include "core/motion/pose.hpp"

namespace seaway::motion {

/// Free directions in earth axes; the others are held or prescribed.
template <int Dim>
using FreeDofs = std::array<bool, n_dof<Dim>>;

/// Throws Error(invalid_argument) for a motion that a section does not have.
template <int Dim>
FreeDofs<Dim> free_dofs(std::span<const Dof> free);
template <int Dim>
FreeDofs<Dim> free_dofs(std::initializer_list<Dof> free) {
  return free_dofs<Dim>(std::span<const Dof>(free.begin(), free.size()));
}

template <int Dim>
struct RigidBody {
  using Inertia = Eigen::Matrix<double, n_angular<Dim>, n_angular<Dim>>;
  double mass = 0;                    ///< [kg], in 2-D [kg/m]
  Vec<Dim> cog = Vec<Dim>::Zero();    ///< in hull axes [m]
  Inertia inertia = Inertia::Zero();  ///< about the cog in body axes [kg m2], in 2-D [kg m]
};

/// Inertia from gyradii about x, y, z through the cog. Throws Error(invalid_argument) unless the
/// mass is positive and the gyradii (2-D: the first) are positive and possible for a body in space.
template <int Dim>
RigidBody<Dim> make_rigid_body(double mass, const Vec3& cog_in_hull, const Vec3& gyradii);

/// Hull axes (origin where the hull's own description has it) to earth and back.
template <int Dim>
Vec<Dim> hull_to_earth(const RigidBody<Dim>& body, const Pose<Dim>& pose, const Vec<Dim>& x_hull) {
  return to_earth<Dim>(pose, x_hull - body.cog);
}
template <int Dim>
Vec<Dim> earth_to_hull(const RigidBody<Dim>& body, const Pose<Dim>& pose, const Vec<Dim>& x_earth) {
  return to_body<Dim>(pose, x_earth) + body.cog;
}

/// Inertia about the cog in earth axes: R I R^T (2-D: the number itself).
template <int Dim>
typename RigidBody<Dim>::Inertia earth_inertia(const RigidBody<Dim>& body, const Pose<Dim>& pose);

/// M in earth axes.
template <int Dim>
DofMatrix<Dim> mass_matrix(const RigidBody<Dim>& body, const Pose<Dim>& pose);

/// S (S^T M S)^-1 S^T: symmetric, positive semidefinite, zero rows and columns for directions not
/// free.
template <int Dim>
DofMatrix<Dim> effective_inverse_mass(const RigidBody<Dim>& body, const Pose<Dim>& pose,
                                      const FreeDofs<Dim>& free);

/// The load -omega x (I omega) that turning axes add (zero in 2-D), to go with the external loads.
template <int Dim>
DofVector<Dim> gyroscopic_load(const RigidBody<Dim>& body, const Pose<Dim>& pose,
                               const Twist<Dim>& twist);

/// Twist in the new pose with the momentum of the free directions kept: V + M_eff(new) (M(old) -
/// M(new)) V. The same as dt M_eff gyroscopic_load to first order, but conserves angular momentum
/// to rounding; use one of the two. Identity in 2-D.
template <int Dim>
Twist<Dim> keep_momentum(const RigidBody<Dim>& body, const Pose<Dim>& old_pose,
                         const Pose<Dim>& new_pose, const Twist<Dim>& twist,
                         const FreeDofs<Dim>& free);

/// V^T M V / 2 [J], in 2-D [J/m].
template <int Dim>
double kinetic_energy(const RigidBody<Dim>& body, const Pose<Dim>& pose, const Twist<Dim>& twist);

}  // namespace seaway::motion
