// [sphere_deformation] A sphere drawn out into sheets and back; see README.md beside this file.
#include <cmath>

#include "core/base/constants.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/carried_shape.hpp"

namespace seaway::validation {
namespace {

constexpr double duration = 1.5;

bool in_sphere(const Vec3& x) { return (x - Vec3(0.35, 0.35, 0.35)).squaredNorm() < 0.15 * 0.15; }

/// Mean of sin(2 pi x) over a cell.
double mean_sine(double x, double h) { return std::sin(2 * pi * x) * std::sin(pi * h) / (pi * h); }

/// leveque1996: u = 2 sin^2(pi x) sin(2 pi y) sin(2 pi z) and so on, times cos(pi t / duration); means over faces.
double face_velocity(const Vec3& x, const Vec3& h, int axis, double t) {
  double product = (axis == 0 ? 2.0 : -1.0) * std::cos(pi * t / duration);
  for (int a = 0; a < 3; ++a) product *= a == axis ? std::pow(std::sin(pi * x[a]), 2) : mean_sine(x[a], h[a]);
  return product;
}

}  // namespace

void run_sphere_deformation(const Context& context, Results& results) {
  const std::vector<int> meshes = context.quick() ? std::vector<int>{16, 24} : std::vector<int>{16, 32, 48};
  const std::vector<double> errors = carry_on_meshes<3>({in_sphere, 10, face_velocity, duration, 2}, meshes, context.threads, results);
  const std::size_t n = errors.size();
  const double order = std::log(errors[n - 2] / errors[n - 1]) / std::log(static_cast<double>(meshes[n - 1]) / meshes[n - 2]);
  if (!context.quick()) results.expect_below("shape_error", errors[n - 1], "1", 0.10);
  results.expect_above("order", order, "1", context.quick() ? 1.0 : 1.5);
}

}  // namespace seaway::validation
