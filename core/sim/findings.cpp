#include "core/sim/findings.hpp"

#include <algorithm>
#include <cmath>

#include "core/waves/airy.hpp"

namespace seaway::sim {

void Findings::error(std::string field, std::string message, std::string hint) {
  ++n_errors_;
  list_.push_back(
      {Diagnostic::Severity::error, std::move(field), std::move(message), std::move(hint)});
}

void Findings::warning(std::string field, std::string message, std::string hint) {
  list_.push_back(
      {Diagnostic::Severity::warning, std::move(field), std::move(message), std::move(hint)});
}

bool Findings::finite(const std::string& field, double value) {
  if (std::isfinite(value)) return true;
  error(field, fmt::format("{} is not a finite number", value), "give a number");
  return false;
}

bool Findings::positive(const std::string& field, double value) {
  if (value > 0 && std::isfinite(value)) return true;
  error(field, fmt::format("{} is not allowed; it must be above 0", value),
        "give a positive number");
  return false;
}

bool Findings::not_negative(const std::string& field, double value) {
  if (value >= 0 && std::isfinite(value)) return true;
  error(field, fmt::format("{} is not allowed; it must be 0 or more", value),
        "give 0 or a positive number");
  return false;
}

bool Findings::in_range(const std::string& field, double value, double lower, double upper) {
  if (value >= lower && value <= upper) return true;
  error(field, fmt::format("{} is not allowed; allowed: {} to {}", value, lower, upper),
        "give a number in this range");
  return false;
}

bool Findings::above_to(const std::string& field, double value, double lower, double upper) {
  if (value > lower && value <= upper) return true;
  error(field,
        fmt::format("{} is not allowed; allowed: above {} and at most {}", value, lower, upper),
        "give a number in this range");
  return false;
}

bool Findings::whole_in_range(const std::string& field, int value, int lower, int upper) {
  if (value >= lower && value <= upper) return true;
  error(field, fmt::format("{} is not allowed; allowed: {} to {}", value, lower, upper),
        "give a whole number in this range");
  return false;
}

bool Findings::extent(const std::string& field, double lower, double upper) {
  if (std::isfinite(lower) && std::isfinite(upper) && lower < upper) return true;
  error(
      field,
      fmt::format("[{}, {}] is not allowed; two finite numbers, the lower one first", lower, upper),
      "give the ends as [lower, upper]");
  return false;
}

bool CheckState::is_free(Dof dof) const {
  return std::find(c.body.free.begin(), c.body.free.end(), dof) != c.body.free.end();
}

double linear_wave_length(double period, double depth, double gravity) {
  return 2 * pi / waves::linear_wave_number(2 * pi / period, depth, gravity);
}

double linear_wave_period(double length, double depth, double gravity) {
  return 2 * pi / waves::linear_omega(2 * pi / length, depth, gravity);
}

}  // namespace seaway::sim
