// Interface transport alone: a shape of water carried by a given velocity until it should be where it began.
#pragma once

#include <functional>
#include <memory>

#include "core/flow/advection.hpp"

namespace seaway::validation {

/// Unit square or cube of cells^Dim equal cells, `cells` whole blocks.
template <int Dim>
std::unique_ptr<mesh::Forest<Dim>> unit_box(int cells, int threads);

/// Water fraction of every cell from samples^Dim points: 1 inside.
template <int Dim>
void fill_shape(const mesh::Forest<Dim>& forest, const std::function<bool(const Vec<Dim>&)>& inside, int samples,
                flow::FlowState<Dim>& state);

/// Mean of the velocity along an axis over the face of edges h with its middle at x, at time t; solenoidal over cells.
template <int Dim>
using FaceVelocity = std::function<double(const Vec<Dim>& x, const Vec<Dim>& h, int axis, double t)>;

struct CarriedShape {
  double error = 0;     ///< sum of |vof - vof_start| over the shape's volume
  double volume = 0;    ///< relative change
  double overshoot = 0; ///< largest vof above 1 or below 0
  int steps = 0;
};

/// Sub-steps of a Courant number of at most 0.4 until `duration`; velocities are those of the middle of each.
template <int Dim>
CarriedShape carry(const mesh::Forest<Dim>& forest, flow::FlowState<Dim>& state, const FaceVelocity<Dim>& velocity,
                   double duration);

}  // namespace seaway::validation
