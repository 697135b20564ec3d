// Everything that can be said about a case without running it: errors, warnings, hydrostatics, cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/sim/case.hpp"

namespace seaway::sim {

struct Diagnostic {
  enum class Severity { warning, error };
  Severity severity = Severity::error;
  std::string field;    ///< path in the case file, for example hull.compartments[1].wall_thickness_m
  std::string message;  ///< the value, and what is allowed
  std::string hint;     ///< what to do
};

struct StageEstimate {
  std::string name;
  std::int64_t cells = 0;
  std::int64_t steps = 0;
  double dt = 0;
  double cpu_s = 0;
};

struct HydrostaticsSummary {
  bool valid = false;
  double mass = 0, displaced_volume = 0, draft = 0, kb = 0, bm = 0, gm = 0, heel = 0;
  double intact_draft = 0, intact_gm = 0;
  double natural_roll_period_dry = 0;  ///< without added inertia [s]
  double trim = 0;                     ///< 3-D: where it comes to rest, bow down [rad]
  double lcb = 0;                      ///< 3-D: of the centre of buoyancy, from amidships forward [m]
  double wetted_surface = 0;           ///< 3-D [m2]
};

struct CaseReport {
  std::vector<Diagnostic> diagnostics;
  HydrostaticsSummary hydrostatics;
  std::vector<StageEstimate> stages;
  bool ok() const;
};

CaseReport check_case(const Case& c);

}  // namespace seaway::sim
