// How a stage's flow begins: at rest or in the exact wave, mapped from another mesh, or read from a checkpoint.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/field/restrict.hpp"
#include "core/sim/simulation.hpp"
#include "core/sim/tank_sides.hpp"
#include "core/waves/water_fraction.hpp"

namespace seaway::sim {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;
using mesh::BlockShape;

namespace {

/// dt |div w| after mapping: far below what a step leaves, and above rounding.
constexpr double mapped_divergence = 1e-10;

/// Finest cells between the hull and coarser ones. Four hold every stencil at the hull; in space each further
/// one costs a tenth of the cells.
template <int Dim>
constexpr int hull_clearance = Dim == 2 ? 6 : 4;

}  // namespace

template <int Dim>
Simulation<Dim>::Simulation(std::shared_ptr<const Model<Dim>> model, std::unique_ptr<Forest<Dim>> forest,
                            const RunContext& context)
    : model_(std::move(model)), forest_(std::move(forest)), context_(context), state_(*forest_),
      advection_(*forest_, model_->fluids, model_->boundaries),
      projection_(*forest_, model_->fluids, model_->boundaries), slip_flux_(model_->fluids),
      viscosity_(*forest_, model_->fluids, model_->boundaries) {
  const Case& c = model_->description;
  if (model_->hull) {
    const bool fixed = model_->prescribed.empty() && c.body.free.empty();
    mask_ = std::make_unique<flow::HullMask<Dim>>(*forest_, model_->hull, model_->body, hull_clearance<Dim>,
                                                  model_->walls, fixed);
  }
  if (c.zones.generation_length > 0 || c.zones.absorption_length > 0) {
    const bool wave = model_->wave != nullptr;
    const bool out_to_wave = wave && c.zones.absorption_target == Zones::Target::wave;
    const auto sides = tank_sides(c);
    flow::SideZones<Dim> zones;
    for (std::size_t axis = 0; axis < zones.size(); ++axis)
      for (std::size_t side = 0; side < 2; ++side) {
        const TankSide& from = sides[axis + 3 - Dim][side];
        zones[axis][side] = {from.zone, from.incoming ? wave : out_to_wave};
      }
    double rate = c.zones.rate;
    if (rate <= 0) rate = model_->period > 0 ? 10 / model_->period : 6.0;
    zones_ = std::make_unique<flow::WaveZones<Dim>>(*forest_, model_->wave, zones, rate);
  }
  if (model_->turbulence.model != flow::TurbulenceSpec::Model::none) {
    turbulence_ = std::make_unique<flow::KEpsilon<Dim>>(*forest_, model_->fluids, model_->boundaries, model_->turbulence);
    turbulence_->initialise(state_);
  }
  if (mask_ && model_->wall_model != flow::WallModel::slip)
    walls_ = std::make_unique<flow::HullWalls<Dim>>(model_->wall_model, model_->fluids);
  want_step(model_->dt);
  body_.pose = body_.half_pose = model_->start_pose;
  body_.released = c.body.release == Body::Release::at_start;
  advection_.set_flux_visitor([this](int axis, const FaceField<double, Dim>& swept) {
    if (mask_) book_.add_fluxes(*mask_, axis, swept);
    if (zones_ && zones_->drives(axis)) exchanged_ += side_flux(axis, swept);
  });
  clock_.charge("mesh");
}

template <int Dim>
void Simulation<Dim>::initialise() {
  const waves::WaveField* wave = model_->wave.get();
  forest_->for_each_leaf([&](int b) {
    const auto& block = forest_->block(b);
    double* vof = state_.vof.block(b);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      const Vec<Dim> x = block.cell_centre(i), half = 0.5 * block.h;
      double& c = vof[offset<Dim>(i, cell_strides<Dim>())];
      if (wave) c = waves::water_fraction<Dim>(*wave, x - half, x + half, 0.0);
      else c = std::clamp(0.5 - x[Dim - 1] / block.h[Dim - 1], 0.0, 1.0);
    });
  });
  if (mask_) {
    mask_->update(body_.pose, body_.half_pose);
    // Compartments start filled to z = 0, or dry.
    const auto& window = mask_->window();
    window.load_cells(state_.vof, window_vof_);
    window.for_cells([&](const IVec<Dim>& i) {
      const Vec<Dim> x = window.cell_centre(i);
      const auto& spaces = mask_->now().space;
      const int space = spaces.empty() ? mask_->space_at(x) : spaces[static_cast<std::size_t>(window.at(i))];
      if (space <= 0) return;
      const bool flooded = model_->description.hull.compartments[static_cast<std::size_t>(space - 1)].flooded;
      double& c = window_vof_[static_cast<std::size_t>(window.at(i))];
      c = flooded ? std::clamp(0.5 - x[Dim - 1] / window.h()[Dim - 1], 0.0, 1.0) : 0.0;
    });
    window.store_cells(window_vof_, state_.vof);
  }
  field::restrict_cells<double, Dim>(*forest_, state_.vof);
  if (wave) {
    forest_->for_each_leaf([&](int b) {
      const auto& block = forest_->block(b);
      const double top = block.origin[Dim - 1];
      if (top > wave->crest() + block.h[Dim - 1]) return;
      for (int a = 0; a < Dim; ++a) {
        for_box<Dim>(filled<Dim>(0), faces_upper<Dim>(a), [&](const IVec<Dim>& i) {
          const Vec<Dim> x = block.face_centre(i, a);
          if (x[Dim - 1] > wave->elevation(to_vec3<Dim>(x).x(), to_vec3<Dim>(x).y(), 0.0) + 0.5 * block.h[Dim - 1]) return;
          state_.u.block(a, b)[offset<Dim>(i, face_strides<Dim>(a))] = waves::velocity_at<Dim>(*wave, x, 0.0)[a];
        });
      }
      // Walls stay closed; driven ends are set by the zones.
      for (int a = 0; a < Dim; ++a) {
        for (int side = 0; side < 2; ++side) {
          if (block.across(a, side) != mesh::no_block) continue;
          if (model_->boundaries.kind[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] == field::BoundaryKind::open) continue;
          field::for_side_faces<Dim>(a, side, [&](int o) { state_.u.block(a, b)[o] = 0; });
        }
      }
    });
    field::restrict_faces<double, Dim>(*forest_, state_.u);
  }
  clock_.charge("forcing");
  extend_vof_and_settle(dt_, true);
  motion::prescribe<Dim>(model_->prescribed, 0.0, dt_, body_.twist);
  if (zones_) zones_->relax_velocity(state_, 0.5 * dt_, 0.0);
  StepReport report;
  kick(0.5 * dt_, report);
  body_.old_twist = body_.twist;
  if (report.failed) fail(ErrorCode::diverged, "the first pressure solve failed: {}", report.failure);
}

/// Parents of a state that has values in leaves.
template <int Dim>
void Simulation<Dim>::restrict_state() {
  field::restrict_cells<double, Dim>(*forest_, state_.vof);
  field::restrict_cells<double, Dim>(*forest_, state_.p);
  if (turbulence_) {
    field::restrict_cells<double, Dim>(*forest_, state_.tke);
    field::restrict_cells<double, Dim>(*forest_, state_.epsilon);
  }
  field::restrict_faces<double, Dim>(*forest_, state_.u);
  field::restrict_faces<double, Dim>(*forest_, state_.w);
}

template <int Dim>
std::pair<double, double> Simulation<Dim>::adopt(flow::FlowState<Dim>&& state, const BodyState<Dim>& body,
                                                 double time, std::int64_t step, double dt,
                                                 const std::map<int, double>& reservoirs,
                                                 const std::vector<char>* free_cells) {
  state_ = std::move(state);
  if (turbulence_ && !state_.turbulent()) turbulence_->initialise(state_);
  body_ = body;
  time_ = time;
  step_ = step;
  sub_step_ = step;
  dt_ = next_dt_ = dt;
  if (mask_) mask_->update(body_.pose, body_.half_pose);
  restrict_state();
  extend_vof_and_settle(dt_, true);
  book_.reservoirs() = reservoirs;
  const double before = projection_.divergence(state_, dt_);
  double after = before;
  if (free_cells) {
    projection_.prepare(state_, mask_.get(), free_cells);
    (void)projection_.repair(state_, mask_.get(), body_.twist, free_cells, dt_, {mapped_divergence, 400});
    after = projection_.divergence(state_, dt_);
  }
  extend_velocity();
  clock_.charge("mapping");
  return {before, after};
}

template <int Dim>
void Simulation<Dim>::polish() {
  projection_.prepare(state_, mask_.get());
  (void)projection_.repair(state_, mask_.get(), body_.twist, nullptr, dt_, {mapped_divergence, 400});
  clock_.charge("mapping");
}

template <int Dim>
void Simulation<Dim>::restore(flow::FlowState<Dim>&& state, const BodyState<Dim>& body, double time,
                              std::int64_t step, double dt, double next_dt, double exchanged,
                              const std::map<int, double>& reservoirs) {
  state_ = std::move(state);
  body_ = body;
  time_ = time;
  step_ = sub_step_ = step;
  dt_ = dt;
  next_dt_ = next_dt;
  exchanged_ = exchanged;
  restrict_state();
  if (mask_) {
    mask_->update(body_.pose, body_.half_pose);
    mask_->window().load_cells(state_.vof, window_vof_);
    book_.restart(*mask_, window_vof_);
    book_.reservoirs() = reservoirs;
  }
  clock_.charge("checkpoint");
}

#define SEAWAY_INSTANTIATE(D)                                                                                        \
  template Simulation<D>::Simulation(std::shared_ptr<const Model<D>>, std::unique_ptr<Forest<D>>, const RunContext&); \
  template void Simulation<D>::initialise();                                                                         \
  template std::pair<double, double> Simulation<D>::adopt(flow::FlowState<D>&&, const BodyState<D>&, double,          \
                                                          std::int64_t, double, const std::map<int, double>&,         \
                                                          const std::vector<char>*);                                 \
  template void Simulation<D>::restrict_state();                                                                     \
  template void Simulation<D>::polish();                                                                             \
  template void Simulation<D>::restore(flow::FlowState<D>&&, const BodyState<D>&, double, std::int64_t, double,       \
                                       double, double, const std::map<int, double>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::sim
