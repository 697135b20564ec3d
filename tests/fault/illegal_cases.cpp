// SPDX-License-Identifier: GPL-3.0-or-later
// The table of illegal cases. One line each: what, fields that go, change, field at fault, advice.
#include "tests/fault/illegal_requests.hpp"

namespace seaway::stress {
namespace {

std::string x(std::size_t n) { return std::string(n, 'x'); }

std::string times(int n, const std::string& text) {
  std::string out;
  for (int i = 0; i < n; ++i) out += text;
  return out;
}

std::vector<IllegalCase> water() {
  return {
      {"no title", {"title"}, "", "title", "say in a few words"},
      {"a long title", {}, "title: '" + x(201) + "'", "title", "at most 200"},
      {"a title that steers terminals", {}, "title: 'a\\033[2Jb'", "title", "one line"},
      {"no dimension", {"dimension"}, "", "dimension", "2 for a section"},
      {"four dimensions", {}, "dimension: 4", "dimension", "2 for a section"},
      {"no tank", {"tank"}, "", "tank", "give tank.y_m"},
      {"a tank upside down", {"tank.z_m"}, "tank { z_m: 1 z_m: -1 }", "tank.z_m", "the smaller one"},
      {"a tank above the water", {"tank.z_m"}, "tank { z_m: 1 z_m: 2 }", "tank.z_m", "water depth"},
      {"a tank of three ends", {}, "tank { y_m: 9 }", "tank.y_m", "[lower, upper]"},
      {"a tank without an end", {"tank.y_m"}, "tank { y_m: -1 y_m: inf }", "tank.y_m[1]", "finite"},
      {"a tank that is not a number", {"tank.y_m"}, "tank { y_m: nan y_m: 1 }", "tank.y_m[0]", "finite"},
      {"x in a section", {}, "tank { x_m: 0 x_m: 1 }", "tank.x_m", "remove it"},
      {"periodic upwards", {}, "tank { periodic: AXIS_Z }", "tank.periodic[0]", "only x and y"},
      {"an unknown axis", {}, "tank { periodic: 9 }", "tank.periodic[0]", "is no value of Axis"},
      {"no cells", {"mesh"}, "", "mesh.base_cell_m", "edge of the coarsest cell"},
      {"negative cells", {}, "mesh { base_cell_m: -0.1 }", "mesh.base_cell_m", "> 0"},
      {"cells larger than the tank", {}, "mesh { base_cell_m: 50 }", "mesh.base_cell_m", "must fit into the tank"},
      {"stretched cells in a section", {}, "mesh { stretch_x: 2 }", "mesh.stretch_x", "remove it"},
      {"weightless water", {}, "fluids { water_density_kg_per_m3: 0 }", "fluids.water_density_kg_per_m3", ">= 1"},
      {"water in g/cm3", {}, "fluids { water_density_kg_per_m3: 1e6 }", "fluids.water_density_kg_per_m3", "<= 20000"},
      {"air heavier than water", {}, "fluids { air_density_kg_per_m3: 1500 }", "fluids.air_density_kg_per_m3", "<= 1000"},
      {"negative viscosity", {}, "fluids { water_viscosity_m2_per_s: -1e-6 }", "fluids.water_viscosity_m2_per_s", ">= 0"},
      {"no gravity", {}, "fluids { gravity_m_per_s2: 0 }", "fluids.gravity_m_per_s2", "> 0"},
      {"a wave of no kind", {"wave"}, "wave {}", "wave", "write calm"},
      {"a wave without height", {"wave.regular.height_m"}, "", "wave.regular.height_m", "> 0"},
      {"a breaking wave", {}, "wave { regular { height_m: 0.6 } }", "wave.regular.height_m", "lower the wave"},
      {"a wave without a period", {"wave.regular.period_s"}, "", "wave.regular", "exactly one of period_s, frequency_hz and length_m"},
      {"period and length", {}, "wave { regular { length_m: 3 } }", "wave.regular", "exactly one of period_s, frequency_hz and length_m"},
      {"a period of nothing", {}, "wave { regular { period_s: nan } }", "wave.regular.period_s", "finite"},
      {"a head sea in a section", {}, "wave { regular { heading_deg: 180 } }", "wave.regular.heading_deg", "90"},
      {"a phase of turns", {}, "wave { regular { phase_deg: 720 } }", "wave.regular.phase_deg", "360"},
      {"an unknown theory", {}, "wave { regular { theory: 9 } }", "wave.regular.theory", "is no value of Theory"},
      {"a wave longer than the tank", {"wave.regular.period_s"}, "wave { regular { length_m: 30 } }", "tank.y_m", "lengthen the tank"},
      {"negative zones", {}, "zones { generation_length_m: -1 }", "zones.generation_length_m", ">= 0"},
      {"zones longer than the tank", {}, "zones { absorption_length_m: 20 }", "zones.absorption_length_m", "shorten the zones"},
      {"a gauge outside", {}, "outputs { gauges { name: 'far' y_m: 99 } }", "outputs.gauges[1].y_m", "into the tank"},
      {"a gauge without a name", {}, "outputs { gauges { y_m: 0 } }", "outputs.gauges[1].name", "letters, digits"},
      {"a gauge that is a path", {}, "outputs { gauges { name: '../x' } }", "outputs.gauges[1].name", "letters, digits"},
      {"two gauges of a name", {}, "outputs { gauges { name: 'bow' } }", "outputs.gauges[1].name", "its own name"},
      {"65 gauges", {}, "outputs { " + times(65, "gauges { name: 'a' } ") + "}", "outputs.gauges", "0 to 64"},
      {"a probe outside the hull", {}, "outputs { probes { name: 'p' y_m: 99 } }", "outputs.probes[0].y_m", "hull axes"},
      {"a fixed probe outside", {}, "outputs { probes { name: 'p' frame: FRAME_EARTH z_m: 99 } }", "outputs.probes[0].z_m", "into the tank"},
      {"a probe on no hull", {"hull", "body"}, "outputs { probes { name: 'p' frame: FRAME_HULL } }", "outputs.probes[0].frame", "write earth"},
      {"a probe without a name", {}, "outputs { probes { y_m: 0 } }", "outputs.probes[0].name", "letters, digits"},
      {"two probes of a name", {}, "outputs { probes { name: 'p' } probes { name: 'p' } }", "outputs.probes[1].name", "its own name"},
      {"a probe at x in a section", {}, "outputs { probes { name: 'p' x_m: 1 } }", "outputs.probes[0].x_m", "remove it"},
      {"an unknown frame", {}, "outputs { probes { name: 'p' frame: 7 } }", "outputs.probes[0].frame", "is no value of Frame"},
      {"65 probes", {}, "outputs { " + times(65, "probes { name: 'a' } ") + "}", "outputs.probes", "0 to 64"},
      {"samples backwards", {}, "outputs { sample_interval_s: -1 }", "outputs.sample_interval_s", ">= 0"}};
}

std::vector<IllegalCase> hull() {
  return {
      {"a hull without a shape", {"hull.box"}, "", "hull", "give one of box"},
      {"a hull of negative beam", {}, "hull { box { beam_m: -0.3 } }", "hull.box.beam_m", "> 0"},
      {"a hull of length in a section", {}, "hull { box { length_m: 2 } }", "hull.box.length_m", "remove it"},
      {"a sphere in a section", {"hull.compartments"}, "hull { sphere { radius_m: 1 } }", "hull", "use dimension 3"},
      {"an open polygon", {"hull.compartments"},
       "hull { polygon { vertices { y_m: -1 } vertices { y_m: 1 } vertices { y_m: 1 z_m: 1 } vertices { y_m: -1 z_m: 1 } } }",
       "hull.polygon.vertices[3]", "the first corner again"},
      {"a polygon of two corners", {"hull.compartments"}, "hull { polygon { vertices { y_m: -1 } vertices { y_m: 1 } } }",
       "hull.polygon.vertices", "4 to 10000"},
      {"a polygon without area", {"hull.compartments"},
       "hull { polygon { vertices { y_m: -1 } vertices { y_m: 1 } vertices { y_m: 2 } vertices { y_m: -1 } } }", "hull.polygon.vertices",
       "closed outline"},
      {"a polygon that crosses itself", {"hull.compartments"},
       "hull { polygon { vertices { y_m: -.2 } vertices { y_m: .2 z_m: .1 } vertices { y_m: .2 } vertices { y_m: -.2 z_m: .3 } "
       "vertices { y_m: -.2 } } }",
       "hull.polygon.vertices", "in order around the section"},
      {"a table that did not come", {"hull.compartments"}, "hull { offsets_section { file: 'lines.csv' station: 5 } }",
       "hull.offsets_section.file", "send it in files"},
      {"a table of no name", {"hull.compartments"}, "hull { offsets_section { station: 5 } }", "hull.offsets_section.file", "name the table"},
      {"a bilge beyond the beam", {"hull.compartments"}, "hull { rounded_box { beam_m: 0.3 height_m: 0.1 corner_radius_m: 0.2 } }",
       "hull.rounded_box.corner_radius_m", "<= 0.15"},
      {"a compartment without a name", {}, "hull { compartments { y_m: -.1 y_m: 0 z_m: .03 z_m: .05 wall_thickness_m: .02 } }",
       "hull.compartments[1].name", "letters, digits"},
      {"two compartments of a name", {},
       "hull { compartments { name: 'port' y_m: -.1 y_m: 0 z_m: .03 z_m: .05 wall_thickness_m: .02 } }", "hull.compartments[1].name",
       "its own name"},
      {"a compartment without a wall", {},
       "hull { compartments { name: 'a' y_m: -.1 y_m: 0 z_m: .03 z_m: .05 } }", "hull.compartments[1].wall_thickness_m", "> 0"},
      {"a compartment of more than its volume", {},
       "hull { compartments { name: 'a' y_m: -.1 y_m: 0 z_m: .03 z_m: .05 wall_thickness_m: .02 permeability: 1.5 } }",
       "hull.compartments[1].permeability", "<= 1"},
      {"a compartment without height", {}, "hull { compartments { name: 'a' y_m: -.1 y_m: 0 wall_thickness_m: .02 } }",
       "hull.compartments[1].z_m", "[lower, upper]"},
      {"an opening without a place", {},
       "hull { compartments { name: 'a' y_m: -.1 y_m: 0 z_m: .03 z_m: .05 wall_thickness_m: .02 openings { name: 'hole' } } }",
       "hull.compartments[1].openings[0].y_m", "[lower, upper]"},
      {"an opening that steers terminals", {},
       "hull { compartments { name: 'a' y_m: -.1 y_m: 0 z_m: .03 z_m: .05 wall_thickness_m: .02 "
       "openings { name: '\\033[2J' y_m: -.1 y_m: 0 z_m: 0 z_m: .04 } } }",
       "hull.compartments[1].openings[0].name", "one line"},
      {"overlapping compartments", {},
       "hull { compartments { name: 'a' y_m: 0.0 y_m: .1 z_m: .03 z_m: .08 wall_thickness_m: .02 flooded: false } }",
       "hull.compartments[1]", ""}};
}

std::vector<IllegalCase> body() {
  return {
      {"a hull without a body", {"body"}, "", "body", "body.mass and body.cog"},
      {"a body without a hull", {"hull"}, "", "body", "give a hull"},
      {"no mass", {"body.mass_kg_per_m"}, "", "body.mass_kg_per_m", "a mass per metre"},
      {"the mass of a ship", {}, "body { mass_kg: 15 }", "body.mass_kg_per_m", "a mass per metre"},
      {"negative mass", {}, "body { mass_kg_per_m: -15 }", "body.mass_kg_per_m", "> 0"},
      {"a mass that is not a number", {}, "body { mass_kg_per_m: nan }", "body.mass_kg_per_m", "finite"},
      {"a mass that sinks", {}, "body { mass_kg_per_m: 1500 }", "body.mass_kg_per_m", "lower the mass"},
      {"no centre of gravity", {"body.cog"}, "", "body.cog", "KG"},
      {"no inertia", {"body.gyradii"}, "", "body.gyradii.x_m", "radius of gyration"},
      {"negative inertia", {}, "body { gyradii { x_m: -0.1 } }", "body.gyradii.x_m", ">= 0"},
      {"pitch of a section", {}, "body { free: DOF_PITCH }", "body.free[2]", "sway, heave and roll"},
      {"free twice", {}, "body { free: DOF_HEAVE }", "body.free[2]", "remove it"},
      {"free to do nothing", {}, "body { free: DOF_UNSPECIFIED }", "body.free[2]", "for example roll"},
      {"free to do what is not known", {}, "body { free: 20 }", "body.free[2]", "is no value of Dof"},
      {"prescribed what is not known", {}, "body { prescribed { dof: 99 amplitude_m: 1 period_s: 1 } }", "body.prescribed[0].dof",
       "is no value of Dof"},
      {"free and prescribed", {}, "body { prescribed { dof: DOF_ROLL amplitude_deg: 5 period_s: 1 } }", "body.prescribed[0].dof", "one of them"},
      {"a roll in metres", {}, "body { prescribed { dof: DOF_ROLL amplitude_m: 5 period_s: 1 } }", "body.prescribed[0]", "in degrees"},
      {"a motion without a period", {}, "body { prescribed { dof: DOF_SWAY amplitude_m: 0.1 } }", "body.prescribed[0].period_s", "> 0"},
      {"a draft above the water", {}, "body { draft_m: -0.1 }", "body.draft_m", "> 0"},
      {"a heel of more than half a turn", {}, "body { angles { roll_deg: 200 } }", "body.angles.roll_deg", "180"},
      {"a place that is not a number", {}, "body { offset { y_m: nan } }", "body.offset.y_m", "finite"},
      {"a place outside the tank", {}, "body { offset { y_m: 30 } }", "tank.y_m", "body.offset"},
      {"released before the beginning", {}, "body { release { at_time { time_s: -1 } } }", "body.release.at_time.time_s", ">= 0"},
      {"released after no period", {}, "body { release { converged { min_periods: 0 } } }", "body.release.converged.min_periods",
       "1 to 1000"}};
}

std::vector<IllegalCase> run() {
  return {
      {"no stage", {"cascade"}, "", "cascade.stages", "at least one stage"},
      {"17 stages", {"cascade"}, "cascade { " + times(17, "stages { end { time { duration_s: 1 } } } ") + "}", "cascade.stages", "1 to 16"},
      {"a stage without an end", {"cascade"}, "cascade { stages {} }", "cascade.stages[0].end", "time: with duration_s"},
      {"a stage of no time", {"cascade"}, "cascade { stages { end { time {} } } }", "cascade.stages[0].end.time.duration_s", "> 0"},
      {"a stage of endless time", {"cascade"}, "cascade { stages { end { time { duration_s: inf } } } }",
       "cascade.stages[0].end.time.duration_s", "finite"},
      {"a mapping from nowhere", {"cascade"}, "cascade { stages { end { time { duration_s: 1 } } mapping {} } }", "cascade.stages[0].mapping",
       "remove it"},
      {"a mapping of unknown kind", {}, "cascade { stages { end { time { duration_s: 1 } } mapping { method: 9 } } }",
       "cascade.stages[3].mapping.method", "is no value of Method"},
      {"subsets without prbf", {}, "cascade { stages { end { time { duration_s: 1 } } mapping { k: 5 } } }", "cascade.stages[3].mapping.k",
       "remove it"},
      {"a stage that steers terminals", {}, "cascade { stages { name: 'a\\nb' end { time { duration_s: 1 } } } }", "cascade.stages[3].name",
       "one line"},
      {"two stages of a name", {}, "cascade { stages { name: 'fine' end { time { duration_s: 1 } } mesh { hull_cell_m: 0.005 } } }",
       "cascade.stages[3].name", "its own name"},
      {"a band of no cells", {"cascade"}, "cascade { stages { mesh { surface { half_height_m: 1 } } end { time { duration_s: 1 } } } }",
       "cascade.stages[0].mesh.surface[0].cell_m", "> 0"},
      {"a box without a place", {"cascade"}, "cascade { stages { mesh { boxes { cell_m: 1 } } end { time { duration_s: 1 } } } }",
       "cascade.stages[0].mesh.boxes[0].y_m", "[lower, upper]"},
      {"a sweep of more than half a turn", {"cascade"}, "cascade { stages { mesh { hull_sweep_deg: 200 } end { time { duration_s: 1 } } } }",
       "cascade.stages[0].mesh.hull_sweep_deg", "<= 180"},
      {"too coarse for the wave", {"cascade"}, "cascade { stages { mesh { hull_cell_m: 0.005 } end { time { duration_s: 1 } } } } "
       "wave { regular { height_m: 0.002 } }", "cascade.stages[0].mesh.surface", "give hull_cell_m"},
      {"two time steps", {}, "time { steps_per_period: 100 }", "time.steps_per_period", "keep one"},
      {"a time step backwards", {}, "time { dt_s: -0.01 }", "time.dt_s", "> 0"},
      {"no sub-steps", {}, "time { max_substeps: 0 }", "time.max_substeps", "1 to 64"},
      {"too large a Courant number", {}, "time { cfl: 0.9 }", "time.cfl", "<= 0.5"},
      {"a coarse pressure", {}, "numerics { pressure_tolerance: 1 }", "numerics.pressure_tolerance", "<= 0.01"},
      {"no pressure iterations", {}, "numerics { max_pressure_iterations: 0 }", "numerics.max_pressure_iterations", "1 to 100000"}};
}

}  // namespace

std::vector<IllegalCase> illegal_sections() {
  std::vector<IllegalCase> out;
  for (auto part : {water, hull, body, run})
    for (auto& one : part()) out.push_back(std::move(one));
  return out;
}

std::string sphere_case() {
  return "title: 'Sphere' dimension: 3 tank { x_m: -1 x_m: 1 y_m: -1 y_m: 1 z_m: -1 z_m: 0.5 } mesh { base_cell_m: 0.25 } "
         "hull { sphere { radius_m: 0.25 } } body { mass_kg: 32.7 cog { z_m: 0.2 } free: DOF_HEAVE draft_m: 0.25 } time { dt_s: 0.01 } "
         "cascade { stages { mesh { hull_cell_m: 0.0625 } end { time { duration_s: 1 } } } }";
}

std::vector<IllegalCase> illegal_ships() {
  return {{"a tank without length", {"tank.x_m"}, "", "tank.x_m", "[lower, upper]"},
          {"a section", {}, "hull { polygon {} }", "hull", "use dimension 2"},
          {"a mass per metre", {}, "body { mass_kg_per_m: 32 }", "body.mass_kg", "a whole mass"},
          {"a sphere of no radius", {"hull.sphere.radius_m"}, "", "hull.sphere.radius_m", "> 0"},
          {"a deck under water", {}, "hull { wigley { length_m: 1 beam_m: 0.2 draft_m: 0.2 height_m: 0.1 } }", "hull.wigley.height_m",
           "deck above the baseline"},
          {"an STL file without a unit", {}, "hull { stl { file: 'hull.stl' } }", "hull.stl.unit_m", "does not say its unit"},
          {"an STL file that did not come", {}, "hull { stl { file: 'hull.stl' unit_m: 1 } }", "hull.stl.file", "send it in files"},
          {"too much stretch", {}, "mesh { stretch_x: 9 }", "mesh.stretch_x", "4"},
          {"pitch without inertia", {}, "body { free: DOF_PITCH }", "body.gyradii.y_m", "radius of gyration"},
          {"a yaw of more than half a turn", {}, "body { angles { yaw_deg: -181 } }", "body.angles.yaw_deg", "-180"}};
}

}  // namespace seaway::stress
