// The hull of a case as geometry: the mapping from the case's description to core/hull, and where
// the hull floats. 2-D; relative file names are looked up in Case::folder. Pure functions,
// thread-safe.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/hull/hydrostatics.hpp"
#include "core/hull/section_hull.hpp"
#include "core/sim/case.hpp"

namespace seaway::sim {

/// Largest ratio of a cell to the one wanted: tanks that are no whole multiple of the base cell
/// stretch it by so much (mesh::make_tank_grid).
inline constexpr double cell_tolerance = 1.12;

/// The base cell halved until it is not larger than `wanted` to `cell_tolerance`.
/// Before: both positive.
double actual_cell(double base_cell, double wanted);

/// Edge of the cells around the hull in a stage [m]: by the hull rule, else by the finest box
/// around the hull's start position at the calm level, else the base cell.
double hull_cell(const Case& c, const Stage& stage);

/// Hull cells of the stages [m]; the finest is not larger than the base cell.
struct HullCells {
  double finest = 0, coarsest = 0;
};
/// Before: there is a stage.
HullCells hull_cells(const Case& c);

/// A file that a case names: relative names are looked up in its folder.
std::string file_beside_case(const std::string& name, const std::string& folder);

/// The compartments of a case as core/hull takes them; in 2-D the x of their boxes is left out.
template <int Dim>
std::vector<hull::CompartmentSpecOf<Dim>> compartment_specs(const Hull& hull) {
  const auto box = [](const Vec3& lower, const Vec3& upper) {
    return hull::Box<Dim>{from_vec3<Dim>(lower), from_vec3<Dim>(upper)};
  };
  std::vector<hull::CompartmentSpecOf<Dim>> specs;
  for (const Compartment& from : hull.compartments) {
    hull::CompartmentSpecOf<Dim> to{
        from.name, box(from.lower, from.upper), from.wall_thickness, from.permeability, {}};
    for (const Opening& opening : from.openings)
      to.openings.push_back({opening.name, box(opening.lower, opening.upper)});
    specs.push_back(std::move(to));
  }
  return specs;
}

/// Before: shape is not none. Throws nothing; wrong values show in build_section.
hull::SectionSpec section_spec(const Hull& hull, const std::string& folder);

/// Walls of at least so many cells hold water by themselves.
inline constexpr int cells_per_wall = 2;

/// Whether some wall of a compartment is thinner than that in some stage: then all stages work by connected
/// spaces, so that the geometry is the same in all of them.
bool has_thin_walls(const Case& c);

/// How far openings are extended through their walls so that every face between cells on both sides of one
/// meets them [m]: two of the coarsest hull cells.
double opening_reach(const Case& c);

/// Which compartments are open to the sea at the start: those that are flooded.
std::vector<bool> open_compartments(const Hull& hull);

/// nullptr if the case has no hull. The distance table has half the finest hull cell of all stages
/// as spacing and reaches 16 of the coarsest hull cells beyond the hull. Throws as
/// hull::build_section.
std::shared_ptr<const hull::SectionHull> build_section_hull(const Case& c);

/// Draft at the start, upright: Body::draft, or if that is 0 the draft at which the hull floats
/// with the flooded compartments open. Throws Error(invalid_argument) if it does not float.
double start_draft(const Case& c, const hull::Section& section);

/// Rough natural periods of the free motions about a draft [s]; 0: not free, or none.
struct NaturalPeriods {
  double heave = 0, roll = 0;
};
/// From GM [m] and the area of the waterplane [m2], in 2-D its breadth [m].
NaturalPeriods natural_periods(const Case& c, double gm, double waterplane);
NaturalPeriods natural_periods(const Case& c, const hull::Section& section, double draft);

}  // namespace seaway::sim
