#include "core/sim/check_case.hpp"

#include <algorithm>

#include "core/sim/findings.hpp"

namespace seaway::sim {

bool CaseReport::ok() const {
  return std::none_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Diagnostic::Severity::error;
  });
}

CaseReport check_case(const Case& c) {
  CaseReport report;
  Findings findings(report.diagnostics);
  CheckState state{c, findings, report};
  if (c.dim != 2 && c.dim != 3) {
    findings.error("dimension", fmt::format("{} is not allowed", c.dim),
                   "write 2 for a section, 3 for a ship");
    return report;
  }
  check_fluids_and_tank(state);
  check_wave_and_zones(state);
  check_settings(state);
  check_gauges(state);
  check_turbulence(state);
  c.dim == 2 ? check_hull(state) : check_ship_hull(state);
  check_body(state);
  c.dim == 2 ? check_floating(state) : check_ship_floating(state);
  check_probes(state);
  check_stages(state);
  if (report.ok()) estimate_cost(state);
  return report;
}

}  // namespace seaway::sim
