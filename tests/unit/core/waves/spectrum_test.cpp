#include "core/waves/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

using Shape = SpectrumSpec::Shape;

SpectrumSpec spec(Shape shape) {
  SpectrumSpec s;
  s.shape = shape;
  s.peak_period = 1.4;
  s.significant_height = 0.06;
  return s;
}

double moment(const SpectrumSpec& s, int order) {
  const Spectrum density(s);
  double sum = 0;
  const double h = 1e-3;
  for (double f = 0.5 * h; f < 60; f += h) sum += std::pow(f, order) * density(f) * h;
  return sum;
}

TEST(Spectrum, HasTheHeightAndThePeakThatItIsGiven) {
  for (const Shape shape : {Shape::jonswap, Shape::bretschneider, Shape::ittc, Shape::pierson_moskowitz}) {
    const SpectrumSpec s = spec(shape);
    EXPECT_NEAR(4 * std::sqrt(moment(s, 0)), significant_height_of(s), 1e-4 * significant_height_of(s)) << static_cast<int>(shape);
    const Spectrum density(s);
    EXPECT_GT(density(1 / 1.4), density(0.99 / 1.4));
    EXPECT_GT(density(1 / 1.4), density(1.01 / 1.4));
  }
  EXPECT_NEAR(significant_height_of(spec(Shape::ittc)), 0.06, 0.06 * 1e-3) << "173/691 is not quite a quarter";
  EXPECT_EQ(significant_height_of(spec(Shape::bretschneider)), 0.06);
}

TEST(Spectrum, PiersonMoskowitzHeightFollowsFromThePeriod) {
  // Hs = 0.0081-constant form: Hs wp^2 / g = 4 sqrt(0.0081 / 5) = 0.1610.
  const double wp = 2 * pi / 1.4;
  EXPECT_NEAR(significant_height_of(spec(Shape::pierson_moskowitz)) * wp * wp / 9.81, 0.1610, 5e-5);
}

TEST(Spectrum, MeanPeriodsAreThoseOfTheBooks) {
  // Bretschneider: Tz = 0.710 Tp, Te = 0.857 Tp, T1 = 0.772 Tp; JONSWAP with 3.3: Tz = 0.78, Te = 0.90 Tp, to a percent.
  const SpectrumSpec b = spec(Shape::bretschneider), j = spec(Shape::jonswap);
  EXPECT_NEAR(std::sqrt(moment(b, 0) / moment(b, 2)) / 1.4, 0.710, 0.003);
  EXPECT_NEAR(moment(b, -1) / moment(b, 0) / 1.4, 0.857, 0.001);
  EXPECT_NEAR(moment(b, 0) / moment(b, 1) / 1.4, 0.772, 0.001);
  EXPECT_NEAR(std::sqrt(moment(j, 0) / moment(j, 2)) / 1.4, 0.78, 0.01);
  EXPECT_NEAR(moment(j, -1) / moment(j, 0) / 1.4, 0.90, 0.01);
}

TEST(Spectrum, JonswapWithoutEnhancementIsBretschneiders) {
  SpectrumSpec j = spec(Shape::jonswap);
  j.peak_enhancement = 1;
  for (const double f : {0.5, 0.7, 1.0, 2.0})
    EXPECT_NEAR(Spectrum(j)(f), Spectrum(spec(Shape::bretschneider))(f), 1e-7 * Spectrum(j)(f));
}

TEST(Components, CarryTheEnergyBetweenTheCutOffs) {
  SpectrumSpec s = spec(Shape::jonswap);
  const auto sea = make_components(s, 1);
  double part = 0;
  const Spectrum density(s);
  for (double f = 0.5 / 1.4 + 5e-5; f < 2.5 / 1.4; f += 1e-4) part += density(f) * 1e-4;
  const SeaStatistics out = statistics(sea);
  EXPECT_NEAR(out.significant_height, 4 * std::sqrt(part), 1e-4 * 0.06);
  EXPECT_LT(out.significant_height, 0.06);
  EXPECT_GT(out.significant_height, 0.98 * 0.06);
  for (std::size_t i = 1; i < sea.size(); ++i) EXPECT_GT(sea[i].frequency, sea[i - 1].frequency);
}

TEST(Components, FollowFromTheSeedAsDescribed) {
  // mt19937_64 with its own default seed 5489 begins with 14514284786278117030 (its reference implementation).
  const auto sea = make_components(spec(Shape::bretschneider), 5489);
  const double first = static_cast<double>(14514284786278117030ull >> 11) / 9007199254740992.0;
  const double width = 2.0 / 1.4 / 100;
  EXPECT_NEAR(sea[0].frequency, 0.5 / 1.4 + width * first, 1e-15);
  const auto again = make_components(spec(Shape::bretschneider), 5489), other = make_components(spec(Shape::bretschneider), 2);
  EXPECT_EQ(again[57].phase, sea[57].phase);
  EXPECT_NE(other[57].phase, sea[57].phase);
}

TEST(Components, RefuseWhatIsOutOfRange) {
  SpectrumSpec s = spec(Shape::jonswap);
  s.peak_period = 0;
  EXPECT_THROW(make_components(s, 1), Error);
  s = spec(Shape::jonswap);
  s.n_components = 5;
  EXPECT_THROW(make_components(s, 1), Error);
  s = spec(Shape::jonswap);
  s.significant_height = std::nan("");
  EXPECT_THROW(make_components(s, 1), Error);
  s = spec(Shape::jonswap);
  s.upper_cutoff = 1;
  EXPECT_THROW(make_components(s, 1), Error);
}

}  // namespace
}  // namespace seaway::waves
