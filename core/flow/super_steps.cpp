#include "core/flow/super_steps.hpp"

#include <cmath>

#include "core/base/error.hpp"

namespace seaway::flow {

int super_stages(double ratio) {
  constexpr int most = 1000;
  if (!(ratio < 0.5 * most * (most + 1)))
    fail(ErrorCode::diverged, "the step is {:.3g} times the explicit limit of the viscous stress", ratio);
  int stages = 1;
  while (0.5 * stages * (stages + 1) < ratio) ++stages;
  return stages;
}

SuperStep super_step(int stage, int stages) {
  const double w = 2.0 / (static_cast<double>(stages) * (stages + 1));
  if (stage == 1) return {1, 0, w};
  const double j = stage;
  return {(2 * j - 1) / j, (1 - j) / j, (2 * j - 1) / j * w};
}

}  // namespace seaway::flow
