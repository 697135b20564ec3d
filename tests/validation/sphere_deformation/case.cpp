// [sphere_deformation] A sphere drawn out into sheets and back; see README.md beside this file.
#include <fmt/format.h>

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
  Refinement errors{"shape_error", "1", {}, {}, 2, 0.0};
  double volume = 0, overshoot = 0;
  for (const int cells : meshes) {
    const auto forest = unit_box<3>(cells, context.threads);
    flow::FlowState<3> state(*forest);
    fill_shape<3>(*forest, in_sphere, 10, state);
    const CarriedShape shape = carry<3>(*forest, state, face_velocity, duration);
    results.report(fmt::format("shape_error_{}", cells), shape.error, "1");
    errors.h.push_back(1.0 / cells);
    errors.value.push_back(shape.error);
    volume = std::max(volume, std::abs(shape.volume));
    overshoot = std::max(overshoot, shape.overshoot);
  }
  const std::size_t n = errors.value.size();
  const double order = std::log(errors.value[n - 2] / errors.value[n - 1]) / std::log(errors.h[n - 2] / errors.h[n - 1]);
  if (!context.quick()) results.expect_below("shape_error", errors.value.back(), "1", 0.10);
  results.expect_above("order", order, "1", context.quick() ? 1.0 : 1.5);
  results.expect_below("volume_change", volume, "1", 1e-11);
  results.expect_below("overshoot", overshoot, "1", 1e-11);
  results.refinement(errors);
}

}  // namespace seaway::validation
