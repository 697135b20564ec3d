// Compartments and their openings as plain descriptions, the same for sections (Dim 2) and ships (Dim 3), and what
// is wrong with their numbers. All lengths [m], hull axes.
#pragma once

#include <string>
#include <vector>

#include "core/hull/hull.hpp"

namespace seaway::hull {

template <int Dim>
struct OpeningSpecOf {
  std::string name;
  Box<Dim> box;  ///< every wall inside it is taken away
};

template <int Dim>
struct CompartmentSpecOf {
  std::string name;
  Box<Dim> box;
  double wall_thickness = 0;  ///< left between the compartment and the outer surface, >= 0
  double permeability = 1;    ///< part of the space that water can fill, 0 < p <= 1
  std::vector<OpeningSpecOf<Dim>> openings;
};

using OpeningSpec = OpeningSpecOf<2>;
using CompartmentSpec = CompartmentSpecOf<2>;
using ShipOpeningSpec = OpeningSpecOf<3>;
using ShipCompartmentSpec = CompartmentSpecOf<3>;

/// One thing that is wrong with a description.
struct ShapeProblem {
  std::string where;    ///< member of SectionSpec or ShipSpec: "compartments[1].openings[0].y" (x, y, z: extents)
  std::string message;  ///< the value, and what is allowed
  std::string hint;     ///< what to do
};

/// "(lower corner) to (upper corner)".
template <int Dim>
std::string text(const Box<Dim>& box);

/// Boxes, wall and permeability of a compartment and boxes of its openings. A box must be wider than `thinnest` [m]
/// along each axis and lie within `largest` [m] of the origin. `where`: the compartment's name in ShapeProblem.
template <int Dim>
std::vector<ShapeProblem> find_number_problems(const std::string& where, const CompartmentSpecOf<Dim>& compartment,
                                               double thinnest, double largest);

}  // namespace seaway::hull
