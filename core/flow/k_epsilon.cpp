#include "core/flow/k_epsilon.hpp"

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"
#include "core/flow/plic.hpp"
#include "core/flow/super_steps.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::cells_upper;
using field::filled;
using field::for_rows;
using field::offset;
using field::Scratch;
using field::ScratchShape;
using namespace k_epsilon;

template <int Dim>
KEpsilon<Dim>::KEpsilon(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries,
                        const TurbulenceSpec& spec)
    : forest_(forest), fluids_(fluids), boundaries_(boundaries), spec_(spec), nu_t_(forest), strain_(forest),
      damping_(forest, 1.0), diffused_k_(forest), diffused_epsilon_(forest), stage_(forest) {
  if (spec.buoyancy) buoyancy_ = CellField<double, Dim>(forest);
}

template <int Dim>
void KEpsilon<Dim>::initialise(FlowState<Dim>& state) const {
  state.tke = CellField<double, Dim>(forest_, spec_.tke);
  state.epsilon = CellField<double, Dim>(forest_, spec_.epsilon);
}

/// Squares of strain and rotation at the cells' centres, and what follows from them alone.
template <int Dim>
void KEpsilon<Dim>::find_strain(const FlowState<Dim>& state) {
  constexpr int n = BlockShape<Dim>::n;
  using Shape = ScratchShape<Dim>;
  const bool stabilised = spec_.model == TurbulenceSpec::Model::stabilised;
  forest_.for_each_leaf([&](int b) {
    const auto& block = forest_.block(b);
    std::array<Scratch<double, Dim>, Dim> u;
    for (int a = 0; a < Dim; ++a)
      field::gather_faces<double, Dim>(forest_, state.u, a, b, 1, boundaries_, u[static_cast<std::size_t>(a)],
                                       field::face_neighbours<Dim>());
    Scratch<double, Dim> rho;
    if (spec_.buoyancy) {
      field::gather_cells<double, Dim>(forest_, state.vof, b, 1, rho, field::beside<Dim>(Dim - 1));
      for (double& c : rho.data) c = fluids_.rho(c);
    }
    const Vec<Dim> inverse_h = block.h.cwiseInverse();
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      const int at = Shape::at(row), o = offset<Dim>(row, cell_strides<Dim>());
      double strain[n] = {}, rotation[n] = {};
      for (int a = 0; a < Dim; ++a) {
        const int A = Shape::stride(a);
        const double* v = u[static_cast<std::size_t>(a)].data + at;
        for (int i = 0; i < n; ++i) {
          const double normal = inverse_h[a] * (v[i + A] - v[i]);
          strain[i] += 2 * normal * normal;
        }
        for (int d = a + 1; d < Dim; ++d) {
          const int B = Shape::stride(d);
          const double* w = u[static_cast<std::size_t>(d)].data + at;
          for (int i = 0; i < n; ++i) {
            const double across = 0.25 * inverse_h[d] * (v[i + B] - v[i - B] + v[i + A + B] - v[i + A - B]);
            const double along = 0.25 * inverse_h[a] * (w[i + A] - w[i - A] + w[i + B + A] - w[i + B - A]);
            strain[i] += (across + along) * (across + along);
            rotation[i] += (across - along) * (across - along);
          }
        }
      }
      double* p = strain_.block(b) + o;
      double* damping = damping_.block(b) + o;
      for (int i = 0; i < n; ++i) {
        p[i] = strain[i];
        if (stabilised) damping[i] = std::max(1.0, lambda_2 * c_2 / c_1 * strain[i] / (rotation[i] + 1e-15));
      }
      if (!spec_.buoyancy) return;
      const int Z = Shape::stride(Dim - 1);
      const double* r = rho.data + at;
      double* n2 = buoyancy_.block(b) + o;
      for (int i = 0; i < n; ++i)
        n2[i] = -fluids_.gravity * 0.5 * inverse_h[Dim - 1] * (r[i + Z] - r[i - Z]) / r[i];
    });
  });
}

template <int Dim>
void KEpsilon<Dim>::update_nu_t(FlowState<Dim>& state) {
  const double largest = largest_ratio * std::max(fluids_.nu_water, 1e-7);
  forest_.for_each_leaf([&](int b) {
    double* k = state.tke.block(b);
    double* e = state.epsilon.block(b);
    const double* damping = damping_.block(b);
    double* nu_t = nu_t_.block(b);
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      k[i] = std::max(k[i], smallest_tke);
      e[i] = std::max(e[i], smallest_epsilon);
      nu_t[i] = std::min(c_mu * k[i] * k[i] / (e[i] * damping[i]), largest);
    }
  });
  field::restrict_cells<double, Dim>(forest_, state.tke);
  field::restrict_cells<double, Dim>(forest_, state.epsilon);
  field::restrict_cells<double, Dim>(forest_, nu_t_);
}

template <int Dim>
void KEpsilon<Dim>::find_nu_t(FlowState<Dim>& state) {
  find_strain(state);
  update_nu_t(state);
}

template <int Dim>
double KEpsilon<Dim>::diffusion_limit(const FlowState<Dim>& state) const {
  const double nu = std::max(fluids_.nu_air, fluids_.nu_water);
  const double rate = forest_.max_over_leaves(0.0, [&](int b) {
    const auto& block = forest_.block(b);
    double largest = 0, sum = 0;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      // Harmonic means beside a light cell reach twice its own diffusivity.
      const double factor = is_mixed(state.vof.block(b)[i]) ? 2 : 1;
      largest = std::max(largest, factor * (nu + nu_t_.block(b)[i] / sigma_k));
    }
    for (int a = 0; a < Dim; ++a) sum += 1 / (block.h[a] * block.h[a]);
    return 2 * largest * sum;
  });
  return rate > 0 ? 1 / rate : 1e300;
}

/// to = `from` after diffusion over dt.
template <int Dim>
void KEpsilon<Dim>::diffuse(const FlowState<Dim>& state, double dt, double sigma, const CellField<double, Dim>& from,
                            CellField<double, Dim>& to) {
  constexpr int n = BlockShape<Dim>::n;
  using Shape = ScratchShape<Dim>;
  constexpr field::Neighbourhood beside = field::face_neighbours<Dim>();
  const int stages = super_stages(dt / (0.9 * diffusion_limit(state)));
  for (int j = 1; j <= stages; ++j) {
    const SuperStep weight = super_step(j, stages);
    const CellField<double, Dim>& source = j == 1 ? from : stage_;
    forest_.for_each_leaf([&](int b) {
      const auto& block = forest_.block(b);
      Scratch<double, Dim> value, specific, nu;  // specific volume 1 / rho; nu + nu_t / sigma
      field::gather_cells<double, Dim>(forest_, source, b, 1, value, beside);
      field::gather_cells<double, Dim>(forest_, state.vof, b, 1, specific, beside);
      field::gather_cells<double, Dim>(forest_, nu_t_, b, 1, nu, beside);
      for_rows<Dim>(filled<Dim>(-1), filled<Dim>(n + 1), [&](const IVec<Dim>& row) {
        double* s = &specific(row);
        double* m = &nu(row);
        for (int i = 0; i < n + 2; ++i) {
          const double molecular = s[i] * fluids_.rho_water * fluids_.nu_water +
                                   (1 - s[i]) * fluids_.rho_air * fluids_.nu_air;
          s[i] = 1 / fluids_.rho(s[i]);
          m[i] = molecular * s[i] + m[i] / sigma;
        }
      });
      for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
        const int at = Shape::at(row);
        const double* v = value.data + at;
        const double* m = nu.data + at;
        const double* c = specific.data + at;
        double sum[n] = {};
        for (int d = 0; d < Dim; ++d) {
          const int s = Shape::stride(d);
          const double factor = 1 / (block.h[d] * block.h[d]);
          for (int i = 0; i < n; ++i)  // rho: harmonic mean, over the cell's own
            sum[i] += factor * ((m[i] + m[i + s]) / (c[i] + c[i + s]) * (v[i + s] - v[i]) -
                                (m[i] + m[i - s]) / (c[i] + c[i - s]) * (v[i] - v[i - s]));
        }
        const int o = offset<Dim>(row, cell_strides<Dim>());
        double* out = to.block(b) + o;
        const double* start = from.block(b) + o;
        for (int i = 0; i < n; ++i) {
          const double before = j == 2 ? start[i] : out[i];
          const double old = j == 1 ? v[i] : weight.previous * v[i] + weight.before * before;
          out[i] = old + weight.rate * dt * c[i] * sum[i];
        }
      });
    });
    if (j == stages) break;
    field::restrict_cells<double, Dim>(forest_, to);
    if (j == 1) stage_ = to;
    else std::swap(stage_, to);
  }
}

namespace {

/// Sources and sinks of one cell; sinks are divided by their own unknown.
struct Rates {
  double gain_k, gain_e, loss_k, loss_e;
};

/// What does not change within a step.
struct CellForcing {
  double strain, damping, buoyancy;
  double diffusion_k, diffusion_e;  ///< by unit time
  bool stabilised;
};

inline Rates rates_of(double k, double e, const CellForcing& f) {
  const double frequency = e / k;
  const double undamped = c_mu * k * k / e;
  const double nu_t = undamped / f.damping;
  const double production = std::min(nu_t * f.strain, production_limit * e);
  const double for_epsilon = f.stabilised ? undamped * f.strain : production;
  const double buoyant = buoyancy_alpha * nu_t * f.buoyancy;
  return {production + std::max(f.diffusion_k, 0.0) + std::max(-buoyant, 0.0),
          c_1 * frequency * for_epsilon + std::max(f.diffusion_e, 0.0),
          frequency + (std::max(-f.diffusion_k, 0.0) + std::max(buoyant, 0.0)) / k,
          c_2 * frequency + std::max(-f.diffusion_e, 0.0) / e};
}

}  // namespace

/// k and epsilon from before diffusion to after the step; what diffusion did goes in as a rate.
template <int Dim>
void KEpsilon<Dim>::add_sources(FlowState<Dim>& state, double dt) {
  const bool stabilised = spec_.model == TurbulenceSpec::Model::stabilised;
  forest_.for_each_leaf([&](int b) {
    double* k = state.tke.block(b);
    double* e = state.epsilon.block(b);
    const double* diffused_k = diffused_k_.block(b);
    const double* diffused_e = diffused_epsilon_.block(b);
    const double* strain = strain_.block(b);
    const double* damping = damping_.block(b);
    const double* n2 = spec_.buoyancy ? buoyancy_.block(b) : nullptr;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      const double k0 = k[i], e0 = e[i];
      const CellForcing f{strain[i], damping[i], n2 ? n2[i] : 0.0, (diffused_k[i] - k0) / dt,
                          (diffused_e[i] - e0) / dt, stabilised};
      const Rates a = rates_of(k0, e0, f);
      const double k1 = (k0 + dt * a.gain_k) / (1 + dt * a.loss_k);
      const double e1 = (e0 + dt * a.gain_e) / (1 + dt * a.loss_e);
      const Rates c = rates_of(k1, e1, f);
      const double half = 0.5 * dt;
      k[i] = (k0 + half * (a.gain_k + c.gain_k)) / (1 + half * (a.loss_k * k0 / k1 + c.loss_k));
      e[i] = (e0 + half * (a.gain_e + c.gain_e)) / (1 + half * (a.loss_e * e0 / e1 + c.loss_e));
    }
  });
}

/// k of cells at walls anew, from after diffusion: x = sqrt(k) is the one positive root of
///   dt C x^4 + x^3 - k_0 x - dt P = 0,   epsilon = C x^3.
template <int Dim>
void KEpsilon<Dim>::add_wall_sources(FlowState<Dim>& state, double dt, std::span<const NearWallCell> walls) {
  for (const NearWallCell& wall : walls) {
    const double k0 = std::max(diffused_k_.block(wall.block)[wall.cell], smallest_tke);
    const double c = dt * wall.dissipation, p = dt * wall.production;
    double x = std::max(std::sqrt(k0), std::sqrt(std::sqrt(wall.production / wall.dissipation)));
    for (int i = 0; i < 50; ++i) {  // from above: monotone
      const double change = (((c * x + 1) * x * x - k0) * x - p) / ((4 * c * x + 3) * x * x - k0);
      x -= change;
      if (change < 1e-10 * x) break;
    }
    state.tke.block(wall.block)[wall.cell] = x * x;
    state.epsilon.block(wall.block)[wall.cell] = wall.dissipation * x * x * x;
  }
}

template <int Dim>
void KEpsilon<Dim>::advance(FlowState<Dim>& state, double dt, std::span<const NearWallCell> walls) {
  find_nu_t(state);
  diffuse(state, dt, sigma_k, state.tke, diffused_k_);
  diffuse(state, dt, sigma_epsilon, state.epsilon, diffused_epsilon_);
  add_sources(state, dt);
  add_wall_sources(state, dt, walls);
}

template class KEpsilon<2>;
template class KEpsilon<3>;

}  // namespace seaway::flow
