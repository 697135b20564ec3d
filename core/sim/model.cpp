// From the case to what all stages share, and the mesh of a stage.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/flow/near_hull.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/build_ship.hpp"
#include "core/sim/build_wave.hpp"
#include "core/sim/mesh_regions.hpp"
#include "core/sim/simulation.hpp"
#include "core/sim/time_step.hpp"

namespace seaway::sim {
namespace {

/// Values of k and epsilon at the start and where waves come in.
flow::TurbulenceSpec turbulence_of(const Case& c, const waves::WaveField* wave) {
  const Turbulence& t = c.turbulence;
  flow::TurbulenceSpec spec;
  if (!t.has_k_epsilon()) return spec;
  spec.model = t.model == Turbulence::Model::standard ? flow::TurbulenceSpec::Model::standard
                                                      : flow::TurbulenceSpec::Model::stabilised;
  spec.buoyancy = t.buoyancy;
  double speed = t.velocity;
  if (speed <= 0 && wave) speed = pi * wave->height() / wave->period();
  spec.tke = std::max(1.5 * t.intensity * t.intensity * speed * speed, flow::k_epsilon::smallest_tke);
  spec.epsilon = std::max(std::pow(flow::k_epsilon::c_mu, 0.75) * std::pow(spec.tke, 1.5) / t.length_scale,
                          flow::k_epsilon::smallest_epsilon);
  return spec;
}

/// Shortest and longest of the wave's and the rough natural periods; 0 where there is none.
struct Periods {
  double shortest = 0, longest = 0;
  void add(double period) {
    if (!(period > 0) || !std::isfinite(period)) return;
    shortest = shortest > 0 ? std::min(shortest, period) : period;
    longest = std::max(longest, period);
  }
};

/// A sensor sits in the wall's surface: no deeper in the solid than a cell from the fluid.
template <int Dim>
void check_probes_in_fluid(const Model<Dim>& m) {
  if (!m.hull) return;
  const double cell = hull_cells(m.description).finest;
  for (const Probe& probe : m.description.outputs.probes) {
    if (!probe.on_hull) continue;
    const double depth = -m.hull->signed_distance(from_vec3<Dim>(probe.place));
    if (depth > cell)
      fail(ErrorCode::invalid_argument,
           "outputs.probes: '{}' lies {:.4g} m inside the hull's solid, more than a hull cell ({:.4g} m); move it to the wall's surface",
           probe.name, depth, cell);
  }
}

}  // namespace

template <int Dim>
Model<Dim> make_model(const Case& c) {
  SEAWAY_CHECK(c.dim == Dim, "a case of dimension {} was taken for one of {}", c.dim, Dim);
  SEAWAY_CHECK(!c.stages.empty(), "cascade.stages is empty; give at least one stage");
  Model<Dim> m;
  m.description = c;
  m.grid = tank_grid<Dim>(c);
  m.fluids.rho_water = c.fluids.rho_water;
  m.fluids.rho_air = c.fluids.rho_air;
  m.fluids.nu_water = c.fluids.nu_water;
  m.fluids.nu_air = c.fluids.nu_air;
  m.fluids.gravity = c.fluids.gravity;
  m.fluids.viscous = c.fluids.viscous;
  for (const Tank::NoSlip& side : c.tank.no_slip) {
    const int axis = side.axis - (3 - Dim);
    if (axis < 0) continue;
    auto& wall = m.boundaries.wall[static_cast<std::size_t>(axis)][side.upper ? 1 : 0];
    wall.no_slip = true;
    wall.velocity = from_vec3<Dim>(side.velocity);
  }
  m.wall_model = static_cast<flow::WallModel>(c.turbulence.walls);
  if (c.tank.open_top) m.boundaries.kind[Dim - 1][1] = field::BoundaryKind::open;
  m.wave = build_wave(c);
  m.turbulence = turbulence_of(c, m.wave.get());
  Periods periods;
  if (m.wave) periods.add(m.wave->period());
  for (const auto& p : c.body.prescribed) {
    m.prescribed.push_back({p.dof, p.amplitude, p.period, p.ramp});
    periods.add(p.period);
  }
  NaturalPeriods natural;
  if constexpr (Dim == 2) {
    if (c.hull.shape != Hull::Shape::none) {
      const auto section = build_section_hull(c);
      m.hull = section;
      const double draft = start_draft(c, section->section());
      m.rest_cog = from_vec3<Dim>(c.body.cog);
      m.rest_cog[Dim - 1] -= draft;
      natural = natural_periods(c, section->section(), draft);
    }
  } else if (c.hull.shape != Hull::Shape::none) {
    const auto ship = build_surface_hull(c);
    m.hull = ship;
    const double draft = start_draft(c, ship->ship());
    natural = natural_periods(c, ship->ship(), draft);
    m.rest_cog = c.body.cog - Vec3(0, 0, draft);
  }
  if (m.hull) {
    periods.add(natural.roll);
    periods.add(natural.heave);
    m.body = motion::make_rigid_body<Dim>(c.body.mass, c.body.cog, c.body.gyradii);
    const Vec3& turn = c.body.angles;
    m.start_pose = motion::make_pose<Dim>(m.rest_cog + from_vec3<Dim>(c.body.offset), {turn.x(), turn.y(), turn.z()});
    m.free = motion::free_dofs<Dim>(std::span<const Dof>(c.body.free));
    for (const auto& compartment : c.hull.compartments) m.compartments.push_back(compartment.name);
    m.displacement = c.body.mass / c.fluids.rho_water;
    if (has_thin_walls(c)) m.walls = flow::Walls::thin;
  }
  check_probes_in_fluid(m);
  m.period = m.wave ? m.wave->period() : periods.longest;
  double shortest = periods.shortest;
  if (shortest <= 0) shortest = 2 * pi * std::sqrt(std::abs(c.tank.lower.z()) / c.fluids.gravity);
  const double wave_period = m.wave ? m.wave->period() : 0;
  m.dt = time_step(c.time, shortest, wave_period);
  for (const Stage& stage : c.stages) m.stage_dt.push_back(time_step(c.time, stage, shortest, wave_period));
  return m;
}

namespace {

/// Of the blocks that overlap the box swept by the hull, those that come within the margin of the hull itself at some
/// roll angle of the sweep. A ship fills less than half of its box; in a section the box is kept.
mesh::RefineRule<3> refine_about_hull(const Model<3>& m, const MeshRule& rule, const mesh::RefinedBox<3>& box) {
  const double margin = rule.hull_margin > 0 ? rule.hull_margin : 8 * rule.hull_cell;
  const double heave = rule.hull_heave > 0 ? rule.hull_heave : 0.25 * (m.body.cog.z() - m.rest_cog.z());
  const int n_angles = 2 * std::max(1, static_cast<int>(std::ceil(rule.hull_sweep / (4 * degree)))) + 1;
  const double turn = 2 * rule.hull_sweep / (n_angles - 1);
  std::vector<motion::Pose<3>> poses;
  for (int k = 0; k < n_angles; ++k)
    poses.push_back(motion::make_pose<3>(m.start_pose.cog, {-rule.hull_sweep + k * turn, 0, 0}));
  // Cells, and with them the window's clearance, may be longer along x.
  const Vec3 around(margin * m.description.stretch_x, margin, margin + heave);
  const auto in_box = mesh::refine_boxes<3>(m.grid, {{box.lower - around, box.upper + around, box.cell}});
  return [hull = m.hull, body = m.body, poses, around, turn, in_box](const Vec3& lower, const Vec3& upper, int level) {
    if (!in_box(lower, upper, level)) return false;
    for (const auto& pose : poses) {
      const Vec3 r = 0.5 * (lower + upper) - pose.cog;
      const double between = 0.5 * turn * std::hypot(r.y(), r.z());  // what the hull reaches between two angles
      if (flow::comes_near<3>(*hull, body, pose, lower - around, upper + around, between)) return true;
    }
    return false;
  };
}

}  // namespace

template <int Dim>
std::unique_ptr<Forest<Dim>> make_forest(const Model<Dim>& m, const MeshRule& rule, int threads) {
  std::optional<HullPlace<Dim>> place;
  if (m.hull)
    place = HullPlace<Dim>{m.hull->bounds(), m.body.cog, m.start_pose.cog, m.body.cog[Dim - 1] - m.rest_cog[Dim - 1]};
  auto boxes = refined_regions<Dim>(rule, place);
  const int level = boxes.empty() ? 0 : mesh::finest_level<Dim>(m.grid, boxes);
  mesh::RefineRule<Dim> refine = mesh::refine_boxes<Dim>(m.grid, boxes);
  if constexpr (Dim == 3) {
    if (m.hull && rule.hull_cell > 0) {
      const auto about_hull = refine_about_hull(m, rule, boxes.front());
      boxes.erase(boxes.begin());
      refine = [about_hull, others = mesh::refine_boxes<3>(m.grid, boxes)](const Vec3& lower, const Vec3& upper,
                                                                         int at) {
        return others(lower, upper, at) || about_hull(lower, upper, at);
      };
    }
  }
  return std::make_unique<Forest<Dim>>(m.grid, level, refine, threads);
}

template Model<2> make_model<2>(const Case&);
template Model<3> make_model<3>(const Case&);
template std::unique_ptr<Forest<2>> make_forest<2>(const Model<2>&, const MeshRule&, int);
template std::unique_ptr<Forest<3>> make_forest<3>(const Model<3>&, const MeshRule&, int);

}  // namespace seaway::sim
