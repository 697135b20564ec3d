#include "core/waves/stream_function.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

using MeanFlow = RegularWaveSpec::MeanFlow;

// Independent solution of the same equations (12 modes, zero mean Eulerian current, g = 9.81 m/s2).
struct Reference {
  double height, period, depth, length, celerity, crest, trough, e1, e2, e3, u_crest;
};
const Reference references[] = {
    {0.061, 1.4, 2.79, 3.07203, 2.19431, 0.03146, -0.02954, 0.03045, 0.00095, 0.00004, 0.14545},
    {0.061, 1.40056, 2.79, 3.07447, 2.19517, 0.03146, -0.02954, 0.03046, 0.00095, 0.00004, 0.14539},
    {0.04, 1.2, 0.4, 1.94495, 1.62079, 0.02115, -0.01885, 0.01992, 0.00115, 0.00008, 0.13290},
    {0.1, 1.2, 0.4, 1.99015, 1.65846, 0.05744, -0.04256, 0.04869, 0.00717, 0.00125, 0.37975},
    {0.06, 0.93, 0.9, 1.37528, 1.47879, 0.03211, -0.02789, 0.02978, 0.00209, 0.00022, 0.23109},
    {0.05, 2, 0.4, 3.72033, 1.86016, 0.02835, -0.02165, 0.02460, 0.00330, 0.00039, 0.15443},
    {0.1, 1.5, 0.5, 2.87046, 1.91364, 0.05637, -0.04363, 0.04911, 0.00623, 0.00086, 0.31129},
    {0.02, 1, 0.5, 1.51545, 1.51545, 0.01024, -0.00976, 0.00999, 0.00024, 0.00001, 0.06773},
};

RegularWaveSpec spec_of(double height, double period, double depth, MeanFlow mean_flow) {
  RegularWaveSpec spec;
  spec.height = height;
  spec.period = period;
  spec.depth = depth;
  spec.mean_flow = mean_flow;
  return spec;
}

TEST(StreamFunction, MatchesIndependentSolutions) {
  constexpr double printed = 0.6e-5;  // five decimals in the table, rounded
  for (const Reference& r : references) {
    SCOPED_TRACE(::testing::Message() << "H " << r.height << " T " << r.period << " d " << r.depth);
    StreamFunctionProblem p;
    p.height = r.height;
    p.period = r.period;
    p.depth = r.depth;
    p.mean_flow = MeanFlow::zero_eulerian;
    const StreamFunctionSolution s = solve_stream_function(p);
    EXPECT_NEAR(s.length / r.length, 1, 1e-5);
    EXPECT_NEAR(s.celerity, r.celerity, printed);
    EXPECT_NEAR(s.crest, r.crest, printed);
    EXPECT_NEAR(s.trough, r.trough, printed);
    EXPECT_NEAR(s.elevation_modes[0], r.e1, printed);
    EXPECT_NEAR(s.elevation_modes[1], r.e2, printed);
    EXPECT_NEAR(s.elevation_modes[2], r.e3, printed);
    EXPECT_LT(s.residual, 1e-12);
    const auto wave = make_wave(spec_of(r.height, r.period, r.depth, MeanFlow::zero_eulerian));
    EXPECT_NEAR(wave->velocity({0, 0, s.crest}, 0).y(), r.u_crest, printed);
  }
}

TEST(StreamFunction, MatchesIndependentProfiles) {
  const auto check = [](double height, double period, double depth,
                        const std::vector<double>& eta) {
    const auto wave = make_wave(spec_of(height, period, depth, MeanFlow::zero_eulerian));
    const double half = wave->length() / 2;
    for (std::size_t i = 0; i < eta.size(); ++i) {
      const double y = half * static_cast<double>(i) / static_cast<double>(eta.size() - 1);
      EXPECT_NEAR(wave->elevation(0, y, 0), eta[i], 0.6e-6) << "point " << i;  // six decimals
    }
  };
  check(0.061, 1.4, 2.79,
        {0.031456, 0.030276, 0.026850, 0.021501, 0.014705, 0.007026, -0.000951, -0.008676,
         -0.015661, -0.021506, -0.025899, -0.028622, -0.029544});
  check(0.1, 1.2, 0.4,
        {0.057438, 0.054261, 0.045553, 0.033252, 0.019430, 0.005695, -0.006922, -0.017850,
         -0.026825, -0.033764, -0.038673, -0.041593, -0.042562});
}

TEST(StreamFunction, SatisfiesFreeSurfaceConditionsBetweenCollocationPoints) {
  for (const MeanFlow mean_flow : {MeanFlow::zero_eulerian, MeanFlow::zero_transport}) {
    const auto wave = make_wave(spec_of(0.1, 1.2, 0.4, mean_flow));
    const double scale = wave->celerity();
    for (int i = 0; i < 37; ++i) {
      const double y = wave->length() * i / 37.0, d = 1e-5;
      const double eta = wave->elevation(0, y, 0);
      const double slope = (wave->elevation(0, y + d, 0) - wave->elevation(0, y - d, 0)) / (2 * d);
      const Vec3 u = wave->velocity({0, y, eta}, 0);
      // Kinematic: the flow seen by the crest follows the surface (the series stops at 1e-9).
      EXPECT_NEAR(u.z(), (u.y() - wave->celerity()) * slope, 3e-7 * scale);
      EXPECT_NEAR(wave->pressure({0, y, eta}, 0), 0, 1e-5 * 1000 * scale * scale);
    }
  }
}

TEST(StreamFunction, ZeroTransportMovesNoWaterAndZeroEulerianMovesStokesTransport) {
  const auto transport = [](const WaveField& wave) {
    // Flux through a plane, averaged over a period, both by fine mid-point rules.
    constexpr int n_t = 64, n_z = 400;
    double sum = 0;
    for (int i = 0; i < n_t; ++i) {
      const double t = wave.period() * (i + 0.5) / n_t;
      const double height = wave.elevation(0, 0, t) + wave.depth();
      for (int k = 0; k < n_z; ++k) {
        const double z = -wave.depth() + height * (k + 0.5) / n_z;
        sum += wave.velocity({0, 0, z}, t).y() * height / n_z / n_t;
      }
    }
    return sum;
  };
  const auto closed = make_wave(spec_of(0.1, 1.2, 0.4, MeanFlow::zero_transport));
  const auto open = make_wave(spec_of(0.1, 1.2, 0.4, MeanFlow::zero_eulerian));
  const double stokes = 9.81 * 0.01 / (8 * open->celerity());
  EXPECT_NEAR(transport(*closed), 0, 1e-5 * stokes + 1e-7);
  EXPECT_NEAR(transport(*open), open->mean_transport(), 1e-4 * stokes);
  EXPECT_NEAR(open->mean_transport(), stokes, 0.1 * stokes);  // the estimate is of second order
  EXPECT_NEAR(closed->mean_eulerian_velocity(), -stokes / 0.4, 0.1 * stokes / 0.4);
  EXPECT_DOUBLE_EQ(open->mean_eulerian_velocity(), 0);
}

TEST(StreamFunction, LengthAndPeriodAreInverse) {
  for (const MeanFlow mean_flow : {MeanFlow::zero_eulerian, MeanFlow::zero_transport}) {
    StreamFunctionProblem p;
    p.height = 0.1;
    p.period = 1.5;
    p.depth = 0.5;
    p.mean_flow = mean_flow;
    const StreamFunctionSolution by_period = solve_stream_function(p);
    p.period = 0;
    p.length = by_period.length;
    EXPECT_NEAR(solve_stream_function(p).period, 1.5, 1e-10);
  }
}

TEST(StreamFunction, TendsToLinearWaveForSmallHeight) {
  StreamFunctionProblem p;
  p.height = 1e-4;
  p.period = 1.4;
  p.depth = 2.79;
  EXPECT_NEAR(solve_stream_function(p).length, 3.06010, 1e-5);
}

TEST(StreamFunction, SolvesDeepShallowAndSteepWaves) {
  const auto length = [](double height, double period, double depth) {
    StreamFunctionProblem p;
    p.height = height;
    p.period = period;
    p.depth = depth;
    return solve_stream_function(p).length;
  };
  // Third-order Stokes in deep water: omega^2 = g k (1 + (kH/2)^2); the next term is its square.
  const double k = 2 * pi / length(8, 10, 5000);
  const double kh = k * 8 / 2;
  EXPECT_NEAR(4 * pi * pi / 100 / (9.81 * k), 1 + kh * kh, kh * kh * kh * kh);
  EXPECT_GT(length(0.12, 4, 0.4), 7.7);    // length 20 depths, Ursell number 120
  EXPECT_GT(length(0.19, 1.2, 2.0), 2.3);  // about 60 % of the steepness of breaking
}

TEST(StreamFunction, ConvergesCloseToBreaking) {
  // About nine tenths of the highest wave. Published limits to compare with do not exist for this
  // case; the free surface conditions themselves are the test.
  const auto wave = make_wave(spec_of(0.33, 1.2, 2.0, MeanFlow::zero_transport));
  const double limit = highest_wave(wave->length(), 2.0);
  EXPECT_GT(0.33, 0.87 * limit);
  for (int i = 0; i < 50; ++i) {
    const double y = wave->length() * i / 50.0;
    const double p = wave->pressure({0, y, wave->elevation(0, y, 0)}, 0);
    EXPECT_NEAR(p / (9810 * 0.33), 0, 1e-3) << i;
  }
}

TEST(StreamFunction, RefusesBreakingWavesWithLimitInMessage) {
  for (const double height : {0.4, 0.5, 5.0}) {
    try {
      make_wave(spec_of(height, 1.2, 2.0, MeanFlow::zero_transport));
      ADD_FAILURE() << "height " << height << " was accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::invalid_argument);
      EXPECT_THAT(e.what(), ::testing::HasSubstr("highest steady wave is about 0.3"));
    }
  }
}

TEST(StreamFunction, SaysThatNearlySolitaryWavesAreBeyondIt) {
  try {
    make_wave(spec_of(0.1, 10, 0.4, MeanFlow::zero_transport));
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("shorten the wave or use Airy theory"));
  }
}

}  // namespace
}  // namespace seaway::waves
