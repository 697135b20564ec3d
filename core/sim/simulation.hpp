// One stage: the flow on one mesh and the hull in it, from one time to the next.
//
// Time labels (docs/numerics.md, "Time step"): positions, vof and p belong to t; velocities u, w and the
// hull's twist to t + dt/2. A step transports with them over dt, moves the hull, and ends with a projection
// that uses the hull's geometry half a step ahead, so that the next transport is centred again.
#pragma once

#include <memory>
#include <optional>

#include "core/base/run_context.hpp"
#include "core/flow/advection.hpp"
#include "core/flow/hull_extension.hpp"
#include "core/flow/hull_walls.hpp"
#include "core/flow/projection.hpp"
#include "core/flow/viscosity.hpp"
#include "core/flow/volume_book.hpp"
#include "core/flow/wave_zones.hpp"
#include "core/motion/prescribed_motion.hpp"
#include "core/sim/case.hpp"
#include "core/sim/phase_clock.hpp"

namespace seaway::sim {

using flow::CellField;
using flow::FaceField;
using mesh::Forest;

/// What stays the same through all stages of a run, made once from the case.
template <int Dim>
struct Model {
  Case description;
  mesh::TankGrid<Dim> grid;
  flow::FluidProperties fluids;
  flow::TurbulenceSpec turbulence;
  flow::WallModel wall_model = flow::WallModel::slip;
  flow::Boundaries<Dim> boundaries;
  std::shared_ptr<const waves::WaveField> wave;         ///< null in calm water
  std::shared_ptr<const hull::Hull<Dim>> hull;          ///< null without a hull
  flow::Walls walls = flow::Walls::resolved;
  motion::RigidBody<Dim> body;
  Vec<Dim> rest_cog = Vec<Dim>::Zero();                 ///< cog when it floats at its draft, upright
  motion::Pose<Dim> start_pose;
  motion::FreeDofs<Dim> free{};
  std::vector<motion::PrescribedMotion> prescribed;
  std::vector<std::string> compartments;
  double dt = 0;                                        ///< step of the case [s]
  std::vector<double> stage_dt;                         ///< wanted step of each stage [s]
  double period = 0;                                    ///< of the wave, or the longest natural one; 0: none
  double displacement = 0;                              ///< mass / rho_water [m^Dim]; 0 without a hull
};

/// Throws Error(invalid_argument) for what check_case finds.
template <int Dim>
Model<Dim> make_model(const Case& c);

/// The mesh of a stage.
template <int Dim>
std::unique_ptr<Forest<Dim>> make_forest(const Model<Dim>& model, const MeshRule& rule, int threads);

/// The hull's part of the state: everything that is not a field.
template <int Dim>
struct BodyState {
  motion::Pose<Dim> pose;           ///< at t
  motion::Pose<Dim> half_pose;      ///< at t + dt/2, the one in w
  motion::Twist<Dim> twist = motion::Twist<Dim>::Zero();      ///< at t + dt/2
  motion::Twist<Dim> old_twist = motion::Twist<Dim>::Zero();  ///< a step before
  bool released = false;
};

/// What a step did.
struct StepReport {
  linear::SolveReport pressure;
  double courant = 0;       ///< of the whole step
  int substeps = 1;
  bool failed = false;      ///< not finite, or far beyond the step limit: the state is not to be used
  std::string failure;
};

/// Volumes of water [m^Dim].
struct WaterBalance {
  double visible = 0;      ///< in the tank, outside solids
  double exchanged = 0;    ///< added by zones and driven ends since the start of the run
  double reservoir = 0;    ///< owed by the volume book
};

template <int Dim>
class Simulation {
 public:
  Simulation(std::shared_ptr<const Model<Dim>> model, std::unique_ptr<Forest<Dim>> forest,
             const RunContext& context);

  /// The step to go to from now on [s], at first that of the case; a new simulation begins with it.
  void want_step(double dt);

  /// Start of a run: exact wave (or calm water) everywhere, hull at its start pose.
  void initialise();
  /// Start from fields mapped from another mesh at `time`, velocities at time + dt/2: the first step is that of the
  /// run before. `free_cells` are those whose inner faces may be changed to make w solenoidal. Returns dt |div w|
  /// before and after.
  std::pair<double, double> adopt(flow::FlowState<Dim>&& state, const BodyState<Dim>& body, double time,
                                  std::int64_t step, double dt, const std::map<int, double>& reservoirs,
                                  const std::vector<char>* free_cells);
  /// Before the flow is mapped to another mesh: brings dt |div w| to 1e-10 everywhere, so that refined regions
  /// inherit boundary fluxes that add up to nothing.
  void polish();
  /// From a checkpoint: all state as saved; continues to the bit.
  void restore(flow::FlowState<Dim>&& state, const BodyState<Dim>& body, double time, std::int64_t step,
               double dt, double next_dt, double exchanged, const std::map<int, double>& reservoirs);

  StepReport step();
  /// Frees the chosen motions.
  void release() { body_.released = true; }

  double time() const { return time_; }
  double dt() const { return dt_; }
  double next_dt() const { return next_dt_; }
  std::int64_t steps() const { return step_; }
  const Forest<Dim>& forest() const { return *forest_; }
  const flow::FlowState<Dim>& state() const { return state_; }
  flow::FlowState<Dim>& state() { return state_; }
  const BodyState<Dim>& body() const { return body_; }
  const Model<Dim>& model() const { return *model_; }
  const flow::HullMask<Dim>* mask() const { return mask_.get(); }
  flow::InterfacePlanes<Dim>& planes() { return advection_.planes(); }
  PhaseClock& clock() { return clock_; }

  /// Pressure force and moment about the cog on the hull at time t [N, N m; 2-D per metre].
  const motion::DofVector<Dim>& load() const { return load_; }
  /// Friction force and moment, likewise; 0 where the hull slips. Over the last step.
  const motion::DofVector<Dim>& friction() const { return friction_; }
  /// y+ at the hull since the start of the stage, by connected space; empty where the hull slips.
  std::map<int, flow::YPlusRange> y_plus() const { return walls_ ? walls_->y_plus() : std::map<int, flow::YPlusRange>{}; }
  void set_y_plus(const std::map<int, flow::YPlusRange>& ranges) {
    if (walls_) walls_->y_plus() = ranges;
  }
  /// Null without a turbulence model.
  const flow::KEpsilon<Dim>* turbulence() const { return turbulence_.get(); }
  WaterBalance water() const;
  void set_exchanged(double volume) { exchanged_ = volume; }
  double exchanged() const { return exchanged_; }
  const std::map<int, double>& reservoirs() const { return book_.reservoirs(); }
  /// Adds to what the volume book owes to a space (0 sea, 1 + compartment) [m^Dim]: what was lost elsewhere.
  void owe(int space, double volume) {
    if (mask_) book_.reservoirs()[space] += volume;
  }
  /// Visible water in each compartment [m^Dim].
  std::vector<double> compartment_volumes() const;
  /// Height of the surface over z = 0 at a place: water in the column of cells less the depth there [m].
  double elevation(double x, double y) const;
  /// Pressure at a probe [Pa], above that at the open top; 0 while a fixed probe is inside the hull's solid.
  double pressure(const Probe& probe) const;
  double divergence() const { return projection_.divergence(state_, dt_); }
  /// sqrt of the mean of w^2 over the water [m/s].
  double rms_water_velocity() const;

 private:
  void restrict_state();
  void extend_vof_and_settle(double dt, bool restart);
  void extend_velocity();
  void extend_pressure();
  motion::FreeDofs<Dim> free_now() const;
  motion::DofMatrix<Dim> inverse_mass() const;
  void stress(double dt);
  void kick(double dt, StepReport& report);
  void plan_next_step(const StepReport& report);
  double side_flux(int axis, const FaceField<double, Dim>& swept) const;

  std::shared_ptr<const Model<Dim>> model_;
  std::unique_ptr<Forest<Dim>> forest_;
  RunContext context_;
  flow::FlowState<Dim> state_;
  flow::Advection<Dim> advection_;
  flow::Projection<Dim> projection_;
  flow::SlipFlux<Dim> slip_flux_;
  flow::Viscosity<Dim> viscosity_;
  std::unique_ptr<flow::KEpsilon<Dim>> turbulence_;
  std::unique_ptr<flow::HullWalls<Dim>> walls_;
  std::unique_ptr<flow::HullMask<Dim>> mask_;
  flow::HullExtension<Dim> extension_;
  flow::VolumeBook<Dim> book_;
  std::unique_ptr<flow::WaveZones<Dim>> zones_;
  BodyState<Dim> body_;
  motion::DofVector<Dim> load_ = motion::DofVector<Dim>::Zero();
  motion::DofVector<Dim> friction_ = motion::DofVector<Dim>::Zero();
  double time_ = 0, dt_ = 0, next_dt_ = 0, wanted_dt_ = 0;
  std::int64_t step_ = 0, sub_step_ = 0;
  double exchanged_ = 0;
  std::vector<double> window_vof_, window_advected_;
  PhaseClock clock_;
};

extern template class Simulation<2>;
extern template class Simulation<3>;

}  // namespace seaway::sim
