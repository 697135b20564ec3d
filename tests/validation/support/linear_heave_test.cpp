// Linear radiation against the published table of the sphere, limits, and the energy of the waves; the release.
#include "tests/validation/support/linear_heave.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

struct Row {
  double wave_number, added_mass, damping;
};

TEST(LinearHeave, SphereIsThatOfHulme1982) {
  for (const Row& row : {Row{0.05, 0.8764, 0.1036}, Row{0.1, 0.8627, 0.1816}, Row{0.3, 0.7157, 0.3254}, Row{0.5, 0.5861, 0.3391},
                         Row{1, 0.4284, 0.2484}, Row{2, 0.3884, 0.1031}, Row{4, 0.4322, 0.0219}, Row{10, 0.4771, 0.0012}}) {
    const HeaveRadiation r = heave_radiation(3, row.wave_number);
    EXPECT_NEAR(r.added_mass, row.added_mass, 3e-4) << row.wave_number;
    EXPECT_NEAR(r.damping, row.damping, 3e-4) << row.wave_number;
  }
}

TEST(LinearHeave, WavesCarryAwayWhatDampingTakes) {
  for (const int dim : {2, 3})
    for (const double k : {0.05, 0.3, 1.0, 3.0, 10.0}) {
      const HeaveRadiation r = heave_radiation(dim, k);
      EXPECT_NEAR(r.damping_of_waves, r.damping, 1e-3 * r.damping + 1e-5) << dim << " " << k;
    }
}

/// pi/2 rho R^2 and a quarter of the sphere's displaced mass: the surface is then one of constant potential.
TEST(LinearHeave, FastMotionsSeeHalfOfTheBodyInUnboundedFluid) {
  EXPECT_NEAR(heave_radiation(2, 20).added_mass, 1.0, 0.03);
  EXPECT_NEAR(heave_radiation(3, 20).added_mass, 0.5, 0.015);
}

TEST(LinearHeave, LetGoFromRest) {
  const Record heave = linear_heave_decay(2, 12, 0.02);
  EXPECT_NEAR(heave.value[0], 1, 1e-12);
  // The first moment: weight without its buoyancy against the mass and the added mass of fast motions, 4/pi / 2.
  const double t = heave.t[10];
  EXPECT_NEAR((1 - heave.value[10]) / (t * t / 2), 2 / pi, 0.05);
  EXPECT_NEAR(turning_points(heave).front().value, -0.640, 0.001);
}

TEST(LinearHeave, RefusesWaveNumbersOutOfRange) {
  EXPECT_THROW(heave_radiation(2, 0), Error);
  EXPECT_THROW(heave_radiation(3, 21), Error);
}

}  // namespace
}  // namespace seaway::validation
