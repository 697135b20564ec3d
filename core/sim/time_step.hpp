// Which time step a case asks for: said once for the solver and for the estimate of its cost.
#pragma once

#include "core/sim/case.hpp"

namespace seaway::sim {

/// The step [s] of a stage, its own or that of the case, from its length or from the steps in the shortest of the case's
/// periods [s]. By steps in a period there is a whole number of them in a wave period [s] (0: no waves), so that harmonic
/// fits see every phase alike.
double time_step(const TimeControl& time, const Stage& stage, double shortest_period, double wave_period);

/// The step of the case alone.
double time_step(const TimeControl& time, double shortest_period, double wave_period);

}  // namespace seaway::sim
