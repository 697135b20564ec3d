// From the plain description of a hull section to its solid: outer polygon, walls, compartments.
//
// The space of a compartment is its box, cut to the outer polygon shrunk inwards by the wall
// thickness. The solid is the outer polygon less the compartments' spaces and less the openings
// (boxes through walls). A compartment with permeability p < 1 keeps a solid of density 1 - p in
// its space: an opening takes away walls only. All lengths [m], hull axes (y port, z up from the
// baseline).
#pragma once

#include <string>
#include <vector>

#include "core/hull/boolean.hpp"
#include "core/hull/compartment_spec.hpp"

namespace seaway::hull {

struct SectionSpec {
  enum class Shape { box, rounded_box, polygon, offsets };
  Shape shape = Shape::box;
  double beam = 0, height = 0;    ///< box, rounded_box: |y| <= beam / 2, 0 <= z <= height
  double corner_radius = 0;       ///< rounded_box: of the two lower corners; each becomes 16 chords
  Polygon vertices;               ///< polygon: the last corner repeats the first; either sense
  std::string offsets_file;       ///< offsets: table as in offsets_table.hpp
  double station = 0, scale = 1;  ///< offsets: x in the table's unit; lengths are divided by scale
  double extend_to = 0;           ///< offsets: sides go on vertically up to this z [m]; 0: no
  std::vector<CompartmentSpec> compartments;
};

struct CompartmentSpace {
  std::string name;
  double permeability = 1;
  Polygons space;     ///< where water can be (before permeability)
  Polygons openings;  ///< one box an opening
  double area = 0;    ///< of `space` [m2]
};

struct Section {
  Polygon outer;  ///< anticlockwise
  std::vector<CompartmentSpace> compartments;
  std::vector<WeightedLoop> solid;  ///< walls with weight 1, then porous spaces with 1 - p
};

/// Outer polygon, anticlockwise. Throws Error: invalid_argument (sizes that are not positive or not
/// finite, a polygon that is open, too short, flat or crosses itself, offsets as in
/// offsets_table.hpp), not_found (offsets file).
Polygon outer_polygon(const SectionSpec& spec);

/// Everything that build_section would throw for the compartments and openings, and what is legal
/// but useless: an opening that cuts no wall of its compartment or leads nowhere, a compartment
/// outside the hull, two compartments that overlap. `outer` comes from outer_polygon(spec).
std::vector<ShapeProblem> find_compartment_problems(const SectionSpec& spec,
                                                      const Polygon& outer);

/// The whole section. Throws Error(invalid_argument) with the first problem.
Section build_section(const SectionSpec& spec);

/// The boundary of what displaces water when only the compartments with open[i] are open to the
/// sea: the others, with their openings, count as solid. open.size() == compartments.size().
std::vector<WeightedLoop> buoyant_loops(const Section& section, const std::vector<bool>& open);

}  // namespace seaway::hull
