// The list of what is wrong with a case, and the checks that fill it (one file a subject). Internal
// to check_case. Every comparison is written so that NaN fails it.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "core/hull/section_shape.hpp"
#include "core/hull/ship_shape.hpp"
#include "core/sim/case.hpp"
#include "core/sim/check_case.hpp"
#include "core/sim/mesh_regions.hpp"

namespace seaway::sim {

inline constexpr const char* axis_names[3] = {"x", "y", "z"};

class Findings {
 public:
  explicit Findings(std::vector<Diagnostic>& list) : list_(list) {}

  void error(std::string field, std::string message, std::string hint);
  void warning(std::string field, std::string message, std::string hint);

  /// Each returns whether the value is allowed, and reports it as an error if not.
  bool finite(const std::string& field, double value);
  bool positive(const std::string& field, double value);
  bool not_negative(const std::string& field, double value);
  bool in_range(const std::string& field, double value, double lower, double upper);
  /// lower < value <= upper
  bool above_to(const std::string& field, double value, double lower, double upper);
  bool whole_in_range(const std::string& field, int value, int lower, int upper);
  /// lower < upper, both finite.
  bool extent(const std::string& field, double lower, double upper);
  /// Errors so far: a subject whose numbers are wrong is not looked at further.
  int n_errors() const { return n_errors_; }

 private:
  std::vector<Diagnostic>& list_;
  int n_errors_ = 0;
};

/// What later checks know from earlier ones.
struct CheckState {
  const Case& c;
  Findings& findings;
  CaseReport& report;
  bool tank_ok = false, fluids_ok = false, wave_ok = false, base_cell_ok = false;
  int wave_axis = 1;                         ///< the tank's axis along which waves go
  double wave_length = 0, wave_period = 0;   ///< of the wave or of the sea's peak; 0: calm water, or unknown
  double wave_height = 0;                    ///< that cells have to resolve: H, Hs or twice the focused amplitude [m]
  double wave_crest = 0, wave_trough = 0;    ///< how high and deep it is expected to be, both > 0 [m]
  std::optional<hull::Section> section{};    ///< 2-D: if the hull could be built
  std::optional<hull::Ship> ship{};          ///< 3-D: if the hull could be built
  std::optional<HullPlace<3>> place{};       ///< afloat at the start; in 2-D all x are 0
  bool body_ok = false;                      ///< numbers of the body
  double roll_period = 0, heave_period = 0;  ///< rough natural periods; 0: not free or unknown
  bool is_free(Dof dof) const;
  /// Axes of the case in (x, y, z): from 1 in a section, from 0 in a ship's case.
  int first_axis() const { return 3 - c.dim; }
  bool has_hull() const { return c.hull.shape != Hull::Shape::none; }
};

void check_fluids_and_tank(CheckState& s);       // check_tank.cpp
void check_wave_and_zones(CheckState& s);        // check_wave.cpp
void check_settings(CheckState& s);          // check_tank.cpp: time, numerics, intervals
void check_gauges(CheckState& s);            // check_probes.cpp
void check_turbulence(CheckState& s);            // check_turbulence.cpp: model, walls of hull and tank
void check_hull(CheckState& s);                  // check_hull.cpp: shape, compartments
void check_compartment_use(CheckState& s);       // check_hull.cpp: names, floods without an opening
void check_ship_hull(CheckState& s);             // check_ship.cpp: the same in 3-D
void check_compartment_use(CheckState& s);       // check_hull.cpp: names, floods
void check_body(CheckState& s);                  // check_motion.cpp: numbers and freedoms
void check_floating(CheckState& s);  // check_motion.cpp: hydrostatics, place in the tank
void check_place(CheckState& s);     // check_motion.cpp: in the tank, clear of the zones; needs s.place
void check_ship_floating(CheckState& s);  // check_ship.cpp
void check_probes(CheckState& s);    // check_probes.cpp; those on the hull need s.place
void check_stages(CheckState& s);    // check_stages.cpp: mesh rules, ends, resolution
void estimate_cost(CheckState& s);   // estimate_cost.cpp: cells, steps, time

/// Linear dispersion relation omega^2 = g k tanh(k depth): length from period and back [m, s].
double linear_wave_length(double period, double depth, double gravity);
double linear_wave_period(double length, double depth, double gravity);

}  // namespace seaway::sim
