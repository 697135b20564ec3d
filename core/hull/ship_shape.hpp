// From the plain description of a ship to its solid: closed outer surface, walls, compartments.
//
// The space of a compartment is its box, cut to the outer surface moved inwards by the wall
// thickness. That surface is made by moving each vertex so that all facets around it move by the
// thickness along their own normals (flat walls and sharp corners exactly; at curved ones the
// facets turn a little). It fails, with a message, where the wall is thicker than the hull's
// radius of curvature. The solid is what the outer surface encloses less the compartments' spaces
// and less the openings (boxes through walls). A compartment with permeability p < 1 keeps a solid
// of density 1 - p in its space: an opening takes away walls only. All lengths [m], hull axes
// (x forward from amidships, y port, z up from the baseline). Pure functions, thread-safe.
#pragma once

#include <string>
#include <vector>

#include "core/hull/compartment_spec.hpp"
#include "core/hull/surface.hpp"

namespace seaway::hull {

struct ShipSpec {
  enum class Shape { box, rounded_box, cylinder, sphere, wigley, offsets, stl };
  Shape shape = Shape::box;
  double length = 0;            ///< box, rounded_box, cylinder, wigley
  double beam = 0, height = 0;  ///< box, rounded_box, wigley (height of the deck)
  double corner_radius = 0;     ///< rounded_box
  double radius = 0;            ///< cylinder, sphere
  double design_draft = 0;      ///< wigley: height of the parabolic part
  std::string file;             ///< offsets: table as in offsets_table.hpp; stl
  double amidships = 0;         ///< offsets, stl: x of the hull axes' origin in the file's unit
  double scale = 1;             ///< offsets: lengths of the table are divided by it
  double extend_to = 0;         ///< offsets: sides go on vertically up to this z [m]; 0: no
  double unit = 0;              ///< stl: metres in the file's unit (0.001: millimetres); required
  std::vector<ShipCompartmentSpec> compartments;
};

struct ShipCompartment {
  std::string name;
  double permeability = 1;
  Surface space;  ///< where water can be (before permeability)
  std::vector<Box<3>> openings;
  double volume = 0;  ///< of `space` [m3]
};

struct Ship {
  Surface outer;
  std::vector<ShipCompartment> compartments;
  Solid solid;  ///< walls with weight 1, then porous spaces with 1 - p
};

/// Closed outer surface without crossings. Throws Error: invalid_argument (sizes, what
/// offsets_surface and read_stl throw, a surface that crosses itself), not_found (file).
Surface outer_surface(const ShipSpec& spec);

/// `outer` moved inwards by `distance` where its triangles reach the box; elsewhere as it was.
Surface shrunk_within(const Surface& outer, const Box<3>& box, double distance);

/// As find_compartment_problems of a section: everything that build_ship would throw for the
/// compartments and openings, and what is legal but useless. `where` names members of ShipSpec.
std::vector<ShapeProblem> find_compartment_problems(const ShipSpec& spec, const Surface& outer);

/// The ship of a spec whose outer surface is at hand. Before: outer_surface(spec) gave it and
/// find_compartment_problems nothing.
Ship build_ship(const ShipSpec& spec, Surface outer);

/// The whole ship. Throws Error(invalid_argument) with the first problem. About a second for a
/// hull of 30,000 triangles with a few compartments.
Ship build_ship(const ShipSpec& spec);

/// The boundary of what displaces water when only the compartments with open[i] are open to the
/// sea: the others, with their openings, count as solid. open.size() == compartments.size().
Solid buoyant_surfaces(const Ship& ship, const std::vector<bool>& open);

/// A closed box, 12 triangles.
Surface surface_of(const Box<3>& box);

}  // namespace seaway::hull
