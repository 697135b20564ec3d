#include "core/sim/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/field/restrict.hpp"

namespace seaway::sim {

using field::filled;
using mesh::BlockShape;

namespace {

/// Nothing that moves so many cells in a step is a flow (unless the case allows more).
constexpr double lost_courant = 32;

}  // namespace

template <int Dim>
double Simulation<Dim>::side_flux(int axis, const FaceField<double, Dim>& swept) const {
  double sum = 0;
  for (const int b : zones_->blocks()) {
    const auto& block = forest_->block(b);
    const double area = block.cell_volume() / block.h[axis];
    for (int side = 0; side < 2; ++side) {
      if (block.across(axis, side) != mesh::no_block) continue;
      field::for_side_faces<Dim>(axis, side, [&](int o) { sum += (side == 0 ? area : -area) * swept.block(axis, b)[o]; });
    }
  }
  return sum;
}

template <int Dim>
void Simulation<Dim>::extend_vof_and_settle(double dt, bool restart) {
  if (!mask_) return;
  const auto& window = mask_->window();
  window.load_cells(state_.vof, window_vof_);
  window_advected_ = window_vof_;
  extension_.extend_vof(*mask_, window_vof_);
  if (restart) book_.restart(*mask_, window_vof_);
  else book_.settle(*mask_, window_advected_, window_vof_, dt, model_->description.numerics.volume_correction);
  window.store_cells(window_vof_, state_.vof);
  field::restrict_cells<double, Dim>(*forest_, state_.vof);
}

template <int Dim>
void Simulation<Dim>::extend_velocity() {
  if (!mask_) return;
  std::vector<double> u;
  for (int axis = 0; axis < Dim; ++axis) {
    mask_->window().load_faces(state_.u, axis, u);
    extension_.extend_velocity(*mask_, axis, body_.twist, u);
    mask_->window().store_faces(u, axis, state_.u);
  }
  field::restrict_faces<double, Dim>(*forest_, state_.u);
}

/// Cells that open up later start from their neighbours' pressure.
template <int Dim>
void Simulation<Dim>::extend_pressure() {
  if (!mask_) return;
  const auto& window = mask_->window();
  std::vector<double> p;
  window.load_cells(state_.p, p);
  std::vector<char> known(window.size(), 0);
  window.for_cells_on_threads([&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    for (int a = 0; a < Dim; ++a) {
      const auto& aperture = mask_->half().aperture[static_cast<std::size_t>(a)];
      known[at] = known[at] || aperture[at] > 0 || aperture[at + static_cast<std::size_t>(window.stride(a))] > 0;
    }
  });
  IVec<Dim> upper = window.n();
  for (int& u : upper) --u;
  for (int layer = 0; layer < 2; ++layer) {
    using Fill = std::pair<std::size_t, double>;
    const auto fill = window.template collect<Fill>(filled<Dim>(1), upper, [&](const IVec<Dim>& i, std::vector<Fill>& out) {
      const auto at = static_cast<std::size_t>(window.at(i));
      if (known[at]) return;
      double sum = 0;
      int count = 0;
      for (int a = 0; a < Dim; ++a) {
        for (int side = -1; side <= 1; side += 2) {
          const auto from = static_cast<std::size_t>(static_cast<int>(at) + side * window.stride(a));
          if (!known[from]) continue;
          const double rise = a == Dim - 1 ? side * window.h()[a] : 0.0;  // neighbour's height over ours
          sum += p[from] + model_->fluids.rho(window_vof_[from]) * model_->fluids.gravity * rise;
          ++count;
        }
      }
      if (count > 0) out.emplace_back(at, sum / count);
    });
    for (const auto& [at, value] : fill) {
      p[at] = value;
      known[at] = 1;
    }
  }
  window.store_cells(p, state_.p);
  field::restrict_cells<double, Dim>(*forest_, state_.p);  // the next solve starts from the parents too, and so must a resumed run
}

template <int Dim>
motion::FreeDofs<Dim> Simulation<Dim>::free_now() const {
  return body_.released ? model_->free : motion::FreeDofs<Dim>{};
}

template <int Dim>
motion::DofMatrix<Dim> Simulation<Dim>::inverse_mass() const {
  if (!mask_) return motion::DofMatrix<Dim>::Zero();
  const auto free = free_now();
  if (std::none_of(free.begin(), free.end(), [](bool f) { return f; })) return motion::DofMatrix<Dim>::Zero();
  return motion::effective_inverse_mass<Dim>(model_->body, body_.pose, free);
}

/// Viscous and turbulent stress over dt, friction at the hull.
template <int Dim>
void Simulation<Dim>::stress(double dt) {
  if (!model_->description.fluids.viscous) return;
  const CellField<double, Dim>* nu_t = turbulence_ ? &turbulence_->nu_t() : nullptr;
  if (!turbulence_ && !walls_) {
    viscosity_.apply(state_, dt, nu_t);
    return;
  }
  clock_.charge("forcing");
  if (walls_) walls_->find_stress(*mask_, state_, body_.twist);
  if (turbulence_) {
    if (zones_) {
      zones_->relax_scalar(state_.tke, turbulence_->spec().tke, dt);
      zones_->relax_scalar(state_.epsilon, turbulence_->spec().epsilon, dt);
    }
    turbulence_->advance(state_, dt, walls_ ? walls_->near_cells() : std::span<const flow::NearWallCell>{});
    if (mask_) {
      std::vector<double> tke, epsilon;
      mask_->window().load_cells(state_.tke, tke);
      mask_->window().load_cells(state_.epsilon, epsilon);
      extension_.extend_scalars(*mask_, {&tke, &epsilon}, {turbulence_->spec().tke, turbulence_->spec().epsilon});
      mask_->window().store_cells(tke, state_.tke);
      mask_->window().store_cells(epsilon, state_.epsilon);
    }
    turbulence_->update_nu_t(state_);
  }
  viscosity_.apply(state_, dt, nu_t);
  if (walls_) friction_ = walls_->apply(*mask_, state_, body_.twist, dt);
  clock_.charge("turbulence");
}

/// Forces over dt, then the projection: velocities go from half a step before the new positions to half a
/// step after them.
template <int Dim>
void Simulation<Dim>::kick(double dt, StepReport& report) {
  const Case& c = model_->description;
  stress(dt);
  // Before gravity: relaxing the weight's kick as well would make the water lighter in the zones.
  if (zones_) zones_->relax_velocity(state_, time_ + 0.5 * next_dt_, dt);
  projection_.apply_gravity(state_, dt);
  clock_.charge("forcing");
  projection_.prepare(state_, mask_.get());
  clock_.charge("pressure");
  const motion::DofMatrix<Dim> inverse = inverse_mass();
  linear::RigidRows<Dim> rows_now;
  motion::DofVector<Dim> carried = motion::DofVector<Dim>::Zero();
  if (mask_) {
    rows_now = mask_->rigid_rows(mask_->now());
    carried = mask_->carried_weight(window_vof_, model_->fluids);
    const auto& rows_half = projection_.rigid_rows();
    motion::DofVector<Dim> force = motion::gyroscopic_load<Dim>(model_->body, body_.pose, body_.twist);
    force[Dim - 1] -= model_->body.mass * model_->fluids.gravity;
    // The pressure acts on the hull where it is now, while the solve has it half a step ahead.
    force += rows_now.gather(state_.p.data()) - rows_half.gather(state_.p.data());
    force += carried;
    if (walls_) force += friction_;
    body_.twist += dt * (inverse * force);
    // The first pressure is not known beforehand.
    if (step_ > 0) slip_flux_.find(*mask_, state_, body_.twist + dt * (inverse * rows_half.gather(state_.p.data())), dt);
  }
  clock_.charge("hull");
  report.pressure = projection_.project(state_, mask_.get(), body_.twist, inverse, dt,
                                        {c.numerics.pressure_tolerance, c.numerics.max_pressure_iterations},
                                        &slip_flux_);
  clock_.charge("pressure");
  if (!std::isfinite(report.pressure.residual_after)) {
    report.failed = true;
    report.failure = "the pressure is not finite";
    return;
  }
  if (mask_) load_ = rows_now.gather(state_.p.data()) + carried;
  extend_pressure();
  extend_velocity();
  clock_.charge("hull");
}

template <int Dim>
StepReport Simulation<Dim>::step() {
  const Case& c = model_->description;
  StepReport report;
  clock_.charge("output");
  const auto courant = advection_.courant_numbers(state_.w, dt_);
  report.courant = flow::largest_courant<Dim>(courant);
  if (!std::isfinite(report.courant) || report.courant > std::max(lost_courant, 4 * c.time.cfl * c.time.max_substeps)) {
    report.failed = true;
    report.failure = fmt::format("the Courant number reached {:.3g} at t = {:.4f} s", report.courant, time_);
    return report;
  }
  // Without a hull there is no book for what local sub-steps clip.
  const flow::SubStepPlan<Dim> plan = flow::plan_sub_steps<Dim>(*forest_, courant, c.time.cfl, mask_ != nullptr);
  report.substeps = plan.total();
  // Transport with w at t + dt/2.
  if (mask_) book_.begin_step(*mask_, state_);
  std::vector<typename flow::Advection<Dim>::Clip> clips;
  for (int s = 0; s < plan.whole; ++s) {
    const auto more = advection_.advance(state_, dt_ / plan.whole, sub_step_++, plan);
    clips.insert(clips.end(), more.begin(), more.end());
  }
  if (mask_) {
    book_.close_fluxes(*mask_, state_.vof, body_.twist, dt_);
    for (const auto& clip : clips)
      if (!book_.holds(clip.cell)) owe(mask_->space_at(clip.centre), clip.volume);
    book_.undo_wall_fluxes(*mask_, state_.vof, dt_);
  }
  clock_.charge("advection");
  // Move the hull, see where it will be half a step later.
  plan_next_step(report);
  const double old_dt = dt_;
  time_ += dt_;
  ++step_;
  sub_step_ = step_;
  if (mask_) {
    body_.pose = motion::advance(body_.pose, body_.twist, dt_);
    const motion::Twist<Dim> ahead = 2 * body_.twist - body_.old_twist;
    body_.old_twist = body_.twist;
    const bool still = body_.twist.isZero(0) && ahead.isZero(0);
    body_.half_pose = still || !c.numerics.half_step_geometry
                          ? body_.pose
                          : motion::advance(body_.pose, ahead, 0.5 * next_dt_);
    mask_->update(body_.pose, body_.half_pose);
    extend_vof_and_settle(dt_, false);
    motion::prescribe<Dim>(model_->prescribed, time_, next_dt_, body_.twist);
  }
  clock_.charge("hull");
  if (zones_) exchanged_ += zones_->relax_vof(state_.vof, time_, dt_);
  clock_.charge("forcing");
  kick(0.5 * (old_dt + next_dt_), report);
  dt_ = next_dt_;
  return report;
}

template <int Dim>
void Simulation<Dim>::want_step(double dt) {
  wanted_dt_ = dt;
  if (step_ == 0) dt_ = next_dt_ = dt;
}

/// The step stays what it is unless transport would need too many sub-steps; then it changes by 10 % at most. That of a
/// stage before may be longer than what is wanted now.
template <int Dim>
void Simulation<Dim>::plan_next_step(const StepReport& report) {
  const double limit = model_->description.time.cfl * model_->description.time.max_substeps;
  next_dt_ = std::min(dt_, wanted_dt_);
  if (report.courant > limit) next_dt_ = std::min(0.9 * dt_, wanted_dt_);
  else if (dt_ < wanted_dt_ && report.courant * 1.25 < limit) next_dt_ = std::min(wanted_dt_, 1.05 * dt_);
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace seaway::sim
