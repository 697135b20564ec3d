// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/build_wave.hpp"

namespace seaway::sim {

std::shared_ptr<const waves::WaveField> build_wave(const Case& c) {
  if (c.wave.kind == Wave::Kind::none) return nullptr;
  waves::RegularWaveSpec spec;
  spec.theory = c.wave.theory == Wave::Theory::airy ? waves::RegularWaveSpec::Theory::airy
                                                    : waves::RegularWaveSpec::Theory::stream_function;
  spec.mean_flow = c.wave.mean_flow == Wave::MeanFlow::zero_eulerian
                       ? waves::RegularWaveSpec::MeanFlow::zero_eulerian
                       : waves::RegularWaveSpec::MeanFlow::zero_transport;
  spec.height = c.wave.height;
  spec.period = c.wave.period;
  spec.length = c.wave.length;
  spec.depth = -c.tank.lower.z();
  spec.heading = c.wave.heading;
  spec.phase = c.wave.phase;
  spec.gravity = c.fluids.gravity;
  spec.rho = c.fluids.rho_water;
  return waves::make_wave(spec);
}

}  // namespace seaway::sim
