// [zalesak_disk] A slotted disk turned once round; see README.md beside this file.
#include <cmath>

#include "core/base/constants.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/carried_shape.hpp"

namespace seaway::validation {
namespace {

constexpr double reach = 0.43;  ///< the fluid turns as a whole within this radius, beyond it is at rest

bool in_disk(const Vec2& x) {
  const double y = x[0] - 0.5, z = x[1] - 0.75;
  const bool slot = std::abs(y) < 0.025 && z < 0.1;  // open at the bottom
  return y * y + z * z < 0.15 * 0.15 && !slot;
}

/// Stream function of one turn in unit time: u = d psi / dz, w = -d psi / dy.
double psi(double y, double z) {
  const double r = std::min(std::hypot(y - 0.5, z - 0.5), reach);
  return -pi * r * r;
}

double face_velocity(const Vec2& x, const Vec2& h, int axis, double) {
  return axis == 0 ? (psi(x[0], x[1] + 0.5 * h[1]) - psi(x[0], x[1] - 0.5 * h[1])) / h[1]
                   : -(psi(x[0] + 0.5 * h[0], x[1]) - psi(x[0] - 0.5 * h[0], x[1])) / h[0];
}

}  // namespace

void run_zalesak_disk(const Context& context, Results& results) {
  const std::vector<int> meshes = context.quick() ? std::vector<int>{64, 128} : std::vector<int>{64, 128, 256};
  const std::vector<double> errors = carry_on_meshes<2>({in_disk, 16, face_velocity, 1, 1}, meshes, context.threads, results);
  const std::size_t n = errors.size();
  results.expect_below("shape_error", errors[n - 1], "1", context.quick() ? 0.03 : 0.01);
  results.expect_above("order", std::log2(errors[n - 2] / errors[n - 1]), "1", 0.9);
}

}  // namespace seaway::validation
