// Gauges and pressure probes: names and places.
#include <set>

#include "core/sim/findings.hpp"

namespace seaway::sim {
namespace {

void check_names(CheckState& s, const std::string& field, const std::string& name, std::set<std::string>& names,
                 const char* what) {
  if (name.empty()) s.findings.error(field + ".name", fmt::format("the {} has no name", what), "name it");
  if (!names.insert(name).second)
    s.findings.error(field + ".name", fmt::format("'{}' is used twice", name), fmt::format("give each {} its own name", what));
}

/// One coordinate in [low, high].
void check_coordinate(CheckState& s, const std::string& field, double value, double low, double high, const char* where,
                      const char* hint) {
  if (s.findings.finite(field, value) && !(value >= low && value <= high))
    s.findings.error(field, fmt::format("{} m is outside the {}; allowed: {:.6g} to {:.6g}", value, where, low, high), hint);
}

}  // namespace

void check_gauges(CheckState& s) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < s.c.outputs.gauges.size(); ++i) {
    const Gauge& gauge = s.c.outputs.gauges[i];
    const std::string field = fmt::format("outputs.gauges[{}]", i);
    check_names(s, field, gauge.name, names, "gauge");
    const double place[2] = {gauge.x, gauge.y};
    for (int axis = s.first_axis(); axis < 2; ++axis)
      if (s.tank_ok)
        check_coordinate(s, fmt::format("{}.{}_m", field, axis_names[axis]), place[axis], s.c.tank.lower[axis],
                         s.c.tank.upper[axis], "tank", "move the gauge into the tank");
  }
}

void check_probes(CheckState& s) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < s.c.outputs.probes.size(); ++i) {
    const Probe& probe = s.c.outputs.probes[i];
    const std::string field = fmt::format("outputs.probes[{}]", i);
    check_names(s, field, probe.name, names, "probe");
    if (probe.on_hull && !s.has_hull()) {
      s.findings.error(field + ".frame", "there is no hull to move with", "write earth, or leave it out");
      continue;
    }
    for (int axis = s.first_axis(); axis < 3; ++axis) {
      const std::string coordinate = fmt::format("{}.{}_m", field, axis_names[axis]);
      if (probe.on_hull && s.place)
        check_coordinate(s, coordinate, probe.place[axis], s.place->bounds.lower[axis], s.place->bounds.upper[axis],
                         "box around the hull", "hull axes: z from the baseline, y from the centre plane");
      else if (!probe.on_hull && s.tank_ok)
        check_coordinate(s, coordinate, probe.place[axis], s.c.tank.lower[axis], s.c.tank.upper[axis], "tank",
                         "move the probe into the tank");
      else
        s.findings.finite(coordinate, probe.place[axis]);
    }
  }
}

}  // namespace seaway::sim
