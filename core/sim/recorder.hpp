// The channels of a run and their values at a time step. Names, units and signs: docs/conventions.md.
#pragma once

#include <vector>

#include "core/sim/run_observer.hpp"
#include "core/sim/simulation.hpp"

namespace seaway::sim {

template <int Dim>
class Recorder {
 public:
  explicit Recorder(const Model<Dim>& model);
  const std::vector<Channel>& channels() const { return channels_; }
  /// `initial_water`: visible water at the start of the run [m^Dim].
  std::vector<double> values(const Simulation<Dim>& simulation, const StepReport& step, double initial_water) const;
  /// Channel positions of the free motions, and of the loads whose convergence releases the hull.
  const std::vector<std::size_t>& free_motions() const { return free_motions_; }
  const std::vector<std::size_t>& release_loads() const { return release_loads_; }
  const std::vector<std::size_t>& motions() const { return motions_; }

 private:
  std::vector<Channel> channels_;
  std::vector<std::size_t> motions_, free_motions_, release_loads_;
};

extern template class Recorder<2>;
extern template class Recorder<3>;

}  // namespace seaway::sim
