// Particulars, hydrostatics and stability of a ship, intact and with its flooded compartments open:
// what `seaway-run hull` prints. SI, radians. Pure functions, thread-safe.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/hull/ship_hydrostatics.hpp"
#include "core/hull/ship_shape.hpp"

namespace seaway::sim {

/// Upright, even keel.
struct DraftRow {
  double draft = 0;
  hull::ShipHydrostatics water;
};

/// One condition at a given mass.
struct ShipCondition {
  hull::ShipEquilibrium rest;                       ///< heel and trim free
  std::vector<std::pair<double, double>> righting;  ///< (heel, GZ), trim free
  double largest_lever = 0, heel_of_largest = 0;    ///< of `righting`
  double range = 0;  ///< first heel > 0 at which GZ falls below 0; the last one computed if it does not
  struct Flood {
    std::string name;
    double volume = 0;                    ///< water in it at rest [m3]
    Vec3 centre = Vec3::Zero();           ///< of it, hull axes
  };
  std::vector<Flood> flood;
};

struct ShipReport {
  hull::Box<3> bounds;
  int n_triangles = 0;
  double enclosed_volume = 0;
  std::vector<DraftRow> drafts;             ///< from the keel to the lowest deck, tenths
  std::optional<DraftRow> at_draft;         ///< at the stated draft, or where it floats
  double length_waterline = 0, breadth_waterline = 0, block_coefficient = 0;  ///< at that draft
  std::optional<ShipCondition> intact, damaged;  ///< need mass and centre of gravity
};

struct LoadCondition {
  double draft = 0;           ///< 0: where it floats
  double mass = 0;            ///< 0: what it displaces at the draft
  std::optional<Vec3> cog;    ///< without it there is no stability
  double rho = 1000;
  std::vector<bool> open;     ///< flooded compartments; empty: none
};

/// Throws Error(invalid_argument) if the ship does not float with that mass.
ShipReport ship_report(const hull::Ship& ship, const LoadCondition& load);

}  // namespace seaway::sim
