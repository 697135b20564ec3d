#include "tests/validation/cases.hpp"

namespace seaway::validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {"still_water", Suite::quick, "calm water in a closed tank stays calm", run_still_water},
      {"barge_at_rest", Suite::quick, "a hull in calm water makes no currents and stays put",
       run_barge_at_rest},
      {"barge_roll_decay", Suite::quick,
       "roll decay of the barge of Jung et al.: period, turning points, volume, noise, cost",
       run_barge_roll_decay},
      {"barge_heave_decay", Suite::quick, "heave of light and heavy bodies is stable",
       run_barge_heave_decay},
      {"flooding", Suite::quick, "a damaged compartment fills, its sealed neighbour stays dry",
       run_flooding},
      {"wave_train", Suite::quick, "a regular wave keeps height and speed over ten periods",
       run_wave_train},
      {"beach", Suite::quick, "what a damping zone sends back", run_beach},
      {"irregular_sea", Suite::full, "a JONSWAP sea over 100 periods: height, peak, reflection", run_irregular_sea},
      {"dam_break", Suite::quick, "surge front of a column against Martin & Moyce", run_dam_break},
      {"pressure_scaling", Suite::quick, "iterations of the pressure solve, 20 k to 300 k cells",
       run_pressure_scaling},
      {"pressure_scaling_3d", Suite::full, "iterations of the pressure solve of the ship, 0.1 to 3.5 million cells",
       run_pressure_scaling_3d},
      {"mapping", Suite::quick,
       "fields from one mesh to the next: kept, conserved, bounded, accurate", run_mapping},
      {"taylor_green", Suite::quick, "order of the decay of a vortex", run_taylor_green},
      {"viscous_wave", Suite::quick, "a standing wave between viscous fluids against its exact solution",
       run_viscous_wave},
      {"lid_cavity", Suite::quick, "flow in a square driven by its lid against Ghia et al.", run_lid_cavity},
      {"decaying_turbulence", Suite::quick, "k-epsilon without production against its exact solution",
       run_decaying_turbulence},
      {"channel", Suite::quick, "turbulent flow between immersed walls against the law of the wall", run_channel},
      {"wave_train_rans", Suite::quick, "a regular wave with k-epsilon: height, eddy viscosity",
       run_wave_train_rans},
      {"barge_roll_decay_rans", Suite::quick, "roll decay of the barge with k-epsilon and walls",
       run_barge_roll_decay_rans},
      {"kleefsman", Suite::quick, "dam break on a box: pressure at its face against the experiment", run_kleefsman},
      {"spheric10", Suite::full, "side impact in a rolling tank: first peak against 102 runs", run_spheric10},
      {"threads", Suite::quick, "the number of threads changes no bit", run_threads},
      {"ship_held", Suite::full, "a held ship in calm water makes no currents and feels its hydrostatics",
       run_ship_held},
      {"dtmb5415_decay_intact", Suite::ships, "roll decay of the intact ship from 19.6 degrees: period",
       run_dtmb5415_decay_intact, "ship_decay"},
      {"dtmb5415_decay_damaged", Suite::ships,
       "roll decay of the ship with two flooded compartments from 18.3 degrees: nine cycles against the towing tank",
       run_dtmb5415_decay_damaged, "ship_decay"},
      {"cascade_section", Suite::full,
       "the example through three meshes against the finest alone: amplitudes, CPU time saved",
       run_cascade_section},
  };
  return cases;
}

}  // namespace seaway::validation
