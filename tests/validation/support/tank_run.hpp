// A case run by hand, step by step: how validation cases look into a simulation.
#pragma once

#include <memory>

#include "core/sim/simulation.hpp"

namespace seaway::validation {

using Section = sim::Simulation<2>;

/// The first stage of a case at its start (exact wave or calm water, hull at its start pose).
std::unique_ptr<Section> start(const sim::Case& c, int threads);

/// A model's first stage at its start.
template <int Dim>
std::unique_ptr<sim::Simulation<Dim>> start(const std::shared_ptr<const sim::Model<Dim>>& model, int threads);

/// One step; throws Error(diverged) with the reason when it fails.
template <int Dim>
sim::StepReport step(sim::Simulation<Dim>& run);

/// Largest face velocity of water, air and hull [m/s].
template <int Dim>
double max_velocity(const sim::Simulation<Dim>& run);

/// Sway, heave [m] and roll [rad] from the position afloat.
motion::DofVector<2> displacement(const Section& run);

/// Visible water less what was there at the start and what zones and ends added since [m2].
class WaterBook {
 public:
  explicit WaterBook(const Section& run) : before_(run.water().visible) {}
  double error(const Section& run) const {
    const sim::WaterBalance w = run.water();
    return w.visible - before_ - w.exchanged;
  }

 private:
  double before_;
};

/// A run that went on to another stage's mesh, and the largest dt |div w| there before and after
/// the repair.
struct MappedRun {
  std::unique_ptr<Section> run;
  double divergence_before = 0, divergence_after = 0;
};

/// As the cascade does it, with the default method. `from` is used up.
MappedRun map_to_stage(Section& from, const sim::Stage& stage, int threads);

/// The barge of Jung, Chang & Jung (2006) per metre: 0.3 x 0.1 m, draft 0.05 m, 15 kg/m, 0.262 kg
/// m2/m, in 0.9 m of water. Tank +-3.52 m, its grid shifted by parts of `h` so that no side of the
/// hull lies on a grid line. Cells of `h` at the hull and 2 h at the surface within 1 m of it.
sim::Case barge_case(double h, double roll);

/// The same without damping zones, in a closed book: nothing enters or leaves the tank.
sim::Case barge_in_plain_tank(double h, double roll);

/// The wave of the DTMB 5415 tests in a periodic box of one wavelength; cells at the surface are 1/columns of it, columns a
/// power of two times 48 (48 base cells a wavelength are whole blocks).
struct WaveBox {
  static constexpr double height = 0.061, period = 1.4, depth = 2.79;  ///< [m], [s], [m]
  static sim::Case with_columns(int columns);
};

/// A case of client/examples; by default that of ./quickstart: damaged section in beam waves.
sim::Case example_case(const std::string& file = "dtmb5415_section_beam_waves.yaml");

/// For the example: meshes like that of its last stage, about `cells` cells (met to a tenth from 20
/// k to 500 k). Cells by halvings, the rest by the length of the finest bands.
sim::MeshRule example_mesh(std::int64_t cells);

}  // namespace seaway::validation
