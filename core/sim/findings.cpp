#include "core/sim/findings.hpp"

#include <algorithm>
#include <cmath>

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

const char* to_string(Dof dof) {
  switch (dof) {
    case Dof::surge:
      return "surge";
    case Dof::sway:
      return "sway";
    case Dof::heave:
      return "heave";
    case Dof::roll:
      return "roll";
    case Dof::pitch:
      return "pitch";
    case Dof::yaw:
      return "yaw";
  }
  return "unknown";
}

double linear_wave_length(double period, double depth, double gravity) {
  const double omega2 = 4 * pi * pi / (period * period);
  double kd = std::max(omega2 * depth / gravity, std::sqrt(omega2 * depth / gravity));
  for (int i = 0; i < 50; ++i) {  // Newton for kd tanh(kd) = omega^2 d / g
    const double t = std::tanh(kd);
    const double step = (kd * t - omega2 * depth / gravity) / (t + kd * (1 - t * t));
    kd -= step;
    if (std::abs(step) < 1e-14 * kd) break;
  }
  return 2 * pi * depth / kd;
}

double linear_wave_period(double length, double depth, double gravity) {
  const double k = 2 * pi / length;
  return 2 * pi / std::sqrt(gravity * k * std::tanh(k * depth));
}

}  // namespace seaway::sim
