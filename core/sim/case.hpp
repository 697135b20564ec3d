// The whole description of one run as plain structs: SI units, radians, earth axes x forward, y port,
// z up with z = 0 at the calm water level (docs/conventions.md). Built by server/convert from the proto
// message (the only schema users see), or by hand in tests. `dim == 2` is a section in the y-z plane:
// x components are ignored, masses are per metre, free motions are sway, heave, roll.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/constants.hpp"
#include "core/base/vec.hpp"
#include "core/motion/pose.hpp"

namespace seaway::sim {

using motion::Dof;

struct Fluids {
  double rho_water = 1000.0;  ///< [kg/m3]
  double rho_air = 1.2;
  double nu_water = 1.0e-6;  ///< kinematic viscosity [m2/s]
  double nu_air = 1.5e-5;
  double gravity = 9.81;      ///< [m/s2]
  bool viscous = true;        ///< molecular stress in the fluid
};

/// k-epsilon and the walls of the hull.
struct Turbulence {
  /// none: nothing was asked for; molecular stress in its first form, which is not continuous through the surface.
  enum class Model { none, laminar, standard, stabilised };
  enum class Walls { slip, no_slip, wall_function, non_equilibrium };
  Model model = Model::none;
  Walls walls = Walls::slip;
  bool has_k_epsilon() const { return model == Model::standard || model == Model::stabilised; }
  double intensity = 0.01;      ///< sqrt(2 k / 3) over `velocity`, at the start and where waves come in
  double velocity = 0;          ///< [m/s]; 0: pi height / period of the wave
  double length_scale = 0.005;  ///< C_mu^(3/4) k^(3/2) / epsilon there [m]
  bool buoyancy = false;        ///< turbulence is damped where the density falls upwards
};

struct Tank {
  Vec3 lower{0, 0, 0};  ///< tank corners [m]; lower.z is minus the depth
  Vec3 upper{0, 0, 0};
  std::array<bool, 3> periodic{false, false, false};
  bool open_top = true;  ///< pressure 0 at the lid; otherwise a closed wall
  /// A side along which the fluid sticks to the wall; it slips along the others.
  struct NoSlip {
    int axis = 2;
    bool upper = false;       ///< z: the lid, otherwise the bottom
    Vec3 velocity{0, 0, 0};   ///< of the wall, along itself [m/s]
  };
  std::vector<NoSlip> no_slip;
};

/// Waves are functions of (x, t). `none` is calm water.
struct Wave {
  enum class Kind { none, regular, irregular, focused, time_series };
  enum class Theory { stream_function, airy, stokes_5 };
  enum class MeanFlow { zero_transport, zero_eulerian };  ///< closed tanks need zero_transport
  Kind kind = Kind::none;
  Theory theory = Theory::stream_function;
  MeanFlow mean_flow = MeanFlow::zero_transport;
  double height = 0;          ///< regular: crest to trough [m]
  double period = 0;          ///< regular: [s]; exactly one of period and length is > 0
  double length = 0;          ///< regular: [m]
  double heading = pi / 2;    ///< direction the wave goes to, from +x towards port [rad]
  double phase = 0;           ///< regular: phase of the crest at the origin at t = 0 [rad]
  /// irregular, focused: the spectrum and the part of it that is made (core/waves/spectrum.hpp).
  struct Spectrum {
    enum class Shape { jonswap, bretschneider, ittc, pierson_moskowitz };
    Shape shape = Shape::jonswap;
    double peak_period = 0;         ///< [s]
    double peak_enhancement = 3.3;  ///< jonswap
    int components = 100;
    double lower_cutoff = 0.5, upper_cutoff = 2.5;  ///< [1 / peak period]
  } spectrum;
  double significant_height = 0;    ///< irregular, but for pierson_moskowitz [m]
  std::uint64_t seed = 1;           ///< irregular
  double focus_amplitude = 0;       ///< focused: crest (> 0) or trough (< 0) of the linear sum [m]
  double time = 0;                  ///< focused: of the focus; time_series: of the file's first line [s]
  double x = 0, y = 0;              ///< place of the focus or of the measurement [m]
  std::string file;                 ///< time_series
  double lower_frequency = 0, upper_frequency = 0;  ///< time_series [Hz]
};

/// Relaxation towards the wave (or towards rest) next to the tank's ends.
struct Zones {
  double generation_length = 0;  ///< [m] at the end the wave comes from; 0: none
  double absorption_length = 0;  ///< [m] at the other end
  enum class Target { wave, rest };
  Target absorption_target = Target::wave;  ///< what the absorbing end relaxes to; calm water: always rest
  double rate = 0;               ///< largest relaxation rate [1/s]; 0: chosen from the wave
};

struct Opening {
  std::string name;
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  ///< box in hull axes; all solid inside it is taken away
};

/// Space inside the hull: a box, cut to the hull's outer surface less the wall thickness.
struct Compartment {
  std::string name;
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};  ///< [m] hull axes
  double wall_thickness = 0;            ///< shell left between the compartment and the outer surface
  double permeability = 1;              ///< part of the volume that water can fill, 0 < p <= 1
  bool flooded = true;                  ///< filled to z = 0 at the start, otherwise dry
  std::vector<Opening> openings;        ///< to the sea or to another compartment, and vents
};

/// Hull axes: x forward from amidships (2-D: unused), y port from the centre plane, z up from the baseline.
struct Hull {
  /// 2-D: box, rounded_box, polygon, offsets_section. 3-D: box, rounded_box, cylinder (axis along x), sphere,
  /// wigley, offsets_hull, stl.
  enum class Shape { none, box, rounded_box, polygon, offsets_section, cylinder, sphere, wigley, offsets_hull, stl };
  Shape shape = Shape::none;
  double length = 0;                               ///< 3-D: box, rounded_box, cylinder, wigley [m]
  double beam = 0, height = 0, corner_radius = 0;  ///< box, rounded_box; beam and height: wigley [m]
  double radius = 0;                               ///< cylinder, sphere [m]
  double design_draft = 0;                         ///< wigley [m]
  std::vector<std::array<double, 2>> vertices;     ///< polygon (y, z), last corner = first [m]
  std::string offsets_file;                        ///< offsets_section, offsets_hull: table of half-breadths; stl: that file
  double station = 0;                              ///< x of the section in the table's unit; offsets_hull, stl: of amidships
  double scale = 1;                                ///< table lengths are divided by this
  double unit = 0;                                 ///< stl: metres in the file's unit
  double extend_to = 0;                            ///< sides extended vertically up to this z [m]; 0: no
  std::vector<Compartment> compartments;
};

struct Body {
  double mass = 0;                        ///< [kg], in 2-D [kg/m]
  Vec3 cog{0, 0, 0};                      ///< centre of gravity in hull axes [m]; z is KG
  Vec3 gyradii{0, 0, 0};                  ///< about x, y, z through the cog [m]
  std::vector<Dof> free;                  ///< the others are held
  double draft = 0;                       ///< baseline below z = 0 at the start, upright; 0: floats at equilibrium
  Vec3 offset{0, 0, 0};                   ///< start displacement of the cog from there [m]
  Vec3 angles{0, 0, 0};                   ///< start roll, pitch, yaw [rad]
  /// Prescribed motion of one degree of freedom: amplitude sin(2 pi t / period), ramped over `ramp` seconds.
  struct Prescribed {
    Dof dof = Dof::roll;
    double amplitude = 0, period = 1, ramp = 0;
  };
  std::vector<Prescribed> prescribed;
  enum class Release { at_start, at_time, converged };
  Release release = Release::at_start;
  double release_time = 0;                ///< at_time [s]
  double release_tolerance = 0.02;        ///< converged: cycle-to-cycle change of heave force and roll moment
  int release_min_periods = 3, release_max_periods = 8;
};

struct SurfaceBand {
  double cell = 0;         ///< wanted cell edge [m]
  double half_height = 0;  ///< band about z = 0: |z| <= half_height [m]
  double within = std::numeric_limits<double>::infinity();  ///< horizontal distance from the hull's start position [m]
};
struct RefinementBox {
  double cell = 0;
  Vec3 lower{0, 0, 0}, upper{0, 0, 0};
};

/// Cells are the base cell halved until they are not larger than wanted (to 12 %, see mesh::make_tank_grid).
struct MeshRule {
  double hull_cell = 0;              ///< in the region swept by the hull; 0: no rule
  double hull_margin = 0;            ///< beyond the swept region [m]; 0: 8 hull cells
  double hull_sweep = 35 * degree;   ///< largest roll that the region covers
  double hull_heave = 0;             ///< largest heave that it covers [m]; 0: a quarter of the draft
  std::vector<SurfaceBand> surface;
  std::vector<RefinementBox> boxes;
};

struct EndRule {
  enum class Kind { time, converged };
  Kind kind = Kind::time;
  double duration = 0;               ///< time: stage length [s]
  double tolerance = 0.01;           ///< converged: change of amplitude, mean, period over two periods
  double min_periods = 2, max_periods = 20;  ///< counted from the release (first stage) or the stage's start
};

struct Mapping {
  enum class Method { local_rbf, prbf, linear };
  enum class Kernel { r, r3, thin_plate, multiquadric, gaussian, wendland_c2 };
  enum class Ordering { as_is, morton, shuffle };
  Method method = Method::local_rbf;
  int k = 120;                       ///< prbf: number of interleaved subsets
  int subsets = 0;                   ///< prbf: average only so many of them; 0: all
  Kernel kernel = Kernel::r3;
  double shape = 2.0;                ///< multiquadric, gaussian, wendland: length in spacings of the subset
  int tail_degree = 1;
  Ordering ordering = Ordering::as_is;
  std::uint64_t seed = 1;
  bool evaluate_all = true;          ///< prbf: as the paper; false: only at new points
};

struct Stage {
  std::string name;
  MeshRule mesh;
  EndRule end;
  Mapping mapping;                   ///< how the flow came here from the stage before; unused in the first
  double dt = 0;                     ///< [s]; 0: by steps_per_period
  double steps_per_period = 0;       ///< as in TimeControl; dt too is 0: the step of the case
};

struct TimeControl {
  double dt = 0;                     ///< [s]; 0: steps_per_period of the shortest natural or wave period
  double steps_per_period = 120;
  int max_substeps = 16;             ///< advection sub-steps a step before dt is lowered
  double cfl = 0.5;                  ///< per sub-step, sum over directions
};

struct Numerics {
  double pressure_tolerance = 1e-5;  ///< largest dt |div w| left by the projection
  int max_pressure_iterations = 200;
  bool volume_correction = true;
  bool half_step_geometry = true;
};

struct Gauge {
  std::string name;
  double x = 0, y = 0;               ///< [m]
};

/// Pressure sensor, channel pressure.NAME.
struct Probe {
  std::string name;
  bool on_hull = true;               ///< moves with the hull, place in hull axes; otherwise fixed, in earth axes
  Vec3 place{0, 0, 0};               ///< [m]
};

struct Outputs {
  double sample_interval = 0;        ///< [s]; 0: every step
  double snapshot_interval = 0;      ///< [s]; 0: only at stage ends
  std::vector<Gauge> gauges;
  std::vector<Probe> probes;
};

struct Case {
  std::string title;
  int dim = 2;
  Fluids fluids;
  Turbulence turbulence;
  Tank tank;
  double base_cell = 0;              ///< edge of the coarsest cell [m]
  double stretch_x = 1;              ///< 3-D: cells are so many times longer along x; 1..4
  Wave wave;
  Zones zones;
  Hull hull;
  Body body;
  TimeControl time;
  Numerics numerics;
  std::vector<Stage> stages;
  Outputs outputs;
  std::string folder;                ///< where relative file names of the case are looked up
};

}  // namespace seaway::sim
