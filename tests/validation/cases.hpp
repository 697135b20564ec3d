// The list of validation and verification cases of seaway-validate.
//
// To add one: a folder tests/validation/<name>/ with case.cpp (its function, declared below),
// README.md (what is compared with what, and where the reference comes from) and any reference
// data; its source in CMakeLists.txt; a line in cases.cpp. Names of cases and quantities stay for
// good: figures are compared over the years.
#pragma once

#include <string>
#include <vector>

#include "tests/validation/results.hpp"

namespace seaway::validation {

enum class Suite {
  quick,  ///< seconds; part of every check
  full,   ///< minutes; run on request
  ships,  ///< hours; only by name or by this suite
};

struct Context {
  int threads = 1;
  Suite suite = Suite::full;  ///< a case may do less in the quick suite; it says so in its README
  std::string results;        ///< folder in which long cases keep finished runs; empty: none
  bool quick() const { return suite == Suite::quick; }
};

struct Case {
  std::string name;
  Suite suite;       ///< smallest suite that runs it; `full` runs the quick cases as well
  std::string what;  ///< one line for --list
  void (*run)(const Context&, Results&);
  std::string folder = {};  ///< under tests/validation; empty: as the name
};

const std::vector<Case>& all_cases();

void run_still_water(const Context& context, Results& results);
void run_barge_at_rest(const Context& context, Results& results);
void run_barge_roll_decay(const Context& context, Results& results);
void run_barge_heave_decay(const Context& context, Results& results);
void run_cylinder_decay(const Context& context, Results& results);
void run_sphere_decay(const Context& context, Results& results);
void run_flooding(const Context& context, Results& results);
void run_wave_train(const Context& context, Results& results);
void run_beach(const Context& context, Results& results);
void run_irregular_sea(const Context& context, Results& results);
void run_dam_break(const Context& context, Results& results);
void run_pressure_scaling(const Context& context, Results& results);
void run_pressure_scaling_3d(const Context& context, Results& results);
void run_mapping(const Context& context, Results& results);
void run_threads(const Context& context, Results& results);
void run_ship_at_rest(const Context& context, Results& results);
void run_ship_held(const Context& context, Results& results);
void run_dtmb5415_decay_intact(const Context& context, Results& results);
void run_dtmb5415_decay_damaged(const Context& context, Results& results);
void run_dtmb5415_decay_meshes(const Context& context, Results& results);
void run_dtmb5415_damping(const Context& context, Results& results);
void run_dtmb5415_beam_waves(const Context& context, Results& results);
void run_dtmb5415_rao(const Context& context, Results& results);
void run_cascade_section(const Context& context, Results& results);
void run_cascade_ship(const Context& context, Results& results);
void run_viscous_wave(const Context& context, Results& results);
void run_taylor_green(const Context& context, Results& results);
void run_lid_cavity(const Context& context, Results& results);
void run_decaying_turbulence(const Context& context, Results& results);
void run_channel(const Context& context, Results& results);
void run_wave_train_rans(const Context& context, Results& results);
void run_zalesak_disk(const Context& context, Results& results);
void run_sphere_deformation(const Context& context, Results& results);
void run_vortex_across_levels(const Context& context, Results& results);
void run_wave_across_levels(const Context& context, Results& results);
void run_oblique_wave(const Context& context, Results& results);
void run_rolling_tank(const Context& context, Results& results);
void run_rotating_hull(const Context& context, Results& results);
void run_rayleigh_taylor(const Context& context, Results& results);
void run_spheric10(const Context& context, Results& results);
void run_kleefsman(const Context& context, Results& results);
void run_barge_roll_decay_rans(const Context& context, Results& results);

}  // namespace seaway::validation
