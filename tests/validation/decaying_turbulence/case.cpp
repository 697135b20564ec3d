// [decaying_turbulence] k-epsilon without production against its exact solution; see README.md beside this file.
#include <cmath>

#include "core/field/restrict.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"

namespace seaway::validation {

void run_decaying_turbulence(const Context& context, Results& results) {
  constexpr double k0 = 0.01, epsilon0 = 0.02, c_2 = flow::k_epsilon::c_2;
  sim::Case c = one_fluid_tank(0, -1, 32, 32, 1.0 / 32, 1e-6);
  c.tank.periodic = {false, true, false};
  c.stages.front().mesh.boxes = {{1.0 / 64, {0, 0.3, -0.7}, {0, 0.7, -0.3}}};  // level jumps in between
  c.turbulence.model = sim::Turbulence::Model::stabilised;
  c.turbulence.velocity = 1;
  const double time_scale = k0 / epsilon0;
  c.time.dt = time_scale / 20;
  const auto run = start(c, context.threads);
  set_velocity(*run, [](const Vec2&, int axis) { return axis == 0 ? 0.2 : 0.0; });  // carried along
  std::fill(run->state().tke.data().begin(), run->state().tke.data().end(), k0);
  std::fill(run->state().epsilon.data().begin(), run->state().epsilon.data().end(), epsilon0);
  double error = 0;
  Curve computed{"computed", {}, {}, false}, wanted{"exact", {}, {}, true};
  const double start_time = run->time();
  while (run->time() - start_time < 20 * time_scale) {
    step(*run);
    // The kick before the first step belongs to the start: sources act over whole steps from there.
    const double growth = 1 + (c_2 - 1) * (run->time() - start_time) / time_scale;
    const double k = k0 * std::pow(growth, -1 / (c_2 - 1));
    const double epsilon = epsilon0 * std::pow(growth, -c_2 / (c_2 - 1));
    each_cell(*run, [&](int b, int i, const Vec2&) {
      error = std::max({error, std::abs(run->state().tke.block(b)[i] / k - 1),
                        std::abs(run->state().epsilon.block(b)[i] / epsilon - 1)});
    });
    computed.x.push_back((run->time() - start_time) / time_scale);
    computed.y.push_back(run->state().tke.block(run->forest().leaves().front())[0] / k0);
    wanted.x.push_back(computed.x.back());
    wanted.y.push_back(k / k0);
  }
  results.plot({"decay of turbulent energy", "t epsilon_0 / k_0", "k / k_0", {computed, wanted}});
  results.expect_below("error", error, "1", 0.005);
}

}  // namespace seaway::validation
