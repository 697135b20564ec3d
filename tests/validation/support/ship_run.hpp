// The damaged ship of client/examples on one mesh, moving in beam waves from the first step on: what speed and iterations
// in three dimensions are measured with.
#pragma once

#include <memory>

#include "core/sim/simulation.hpp"

namespace seaway::validation {

/// DTMB 5415 with its two flooded compartments, released at a heel of 5 degrees in beam waves of 0.061 m and 1.4 s, zones
/// on both sides. The mesh is of the kind of the examples of size `desk` and has about `cells` cells (60 k to 10 M; met to
/// a few per cent): the hull's cells by halvings of the base cells, between those tank and cells are scaled together.
sim::Case ship_in_waves(std::int64_t cells);

/// What is made once from a case: the hull's surfaces, its table of distances.
std::shared_ptr<const sim::Model<3>> ship_model(const sim::Case& c);

}  // namespace seaway::validation
