// Where the hull is near: decides which blocks are fine and which the hull's window must have.
#pragma once

#include "core/hull/hull.hpp"
#include "core/motion/rigid_body.hpp"

namespace seaway::flow {

/// Whether a box (earth axes) comes within `slack` [m] of the hull at a pose. The box is halved `depth` times along each
/// axis, so that not its circumscribed sphere counts but those of its small parts: never false for a box that does.
template <int Dim>
bool comes_near(const hull::Hull<Dim>& hull, const motion::RigidBody<Dim>& body, const motion::Pose<Dim>& pose,
                const Vec<Dim>& lower, const Vec<Dim>& upper, double slack, int depth = 3) {
  const Vec<Dim> middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  // Away from the walls the table of distances is coarse.
  if (hull.signed_distance(motion::earth_to_hull<Dim>(body, pose, middle)) >= 1.05 * (half.norm() + slack)) return false;
  if (depth == 0) return true;
  for (int child = 0; child < (1 << Dim); ++child) {
    Vec<Dim> corner = lower;
    for (int a = 0; a < Dim; ++a)
      if ((child >> a) & 1) corner[a] = middle[a];
    if (comes_near<Dim>(hull, body, pose, corner, corner + half, slack, depth - 1)) return true;
  }
  return false;
}

}  // namespace seaway::flow
