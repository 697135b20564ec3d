#include "core/hull/hydrostatics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

/// Earth axes through the hull's origin: horizontal u (to port when upright), vertical v.
struct EarthAxes {
  double c, s;
  explicit EarthAxes(double heel) : c(std::cos(heel)), s(std::sin(heel)) {}
  Vec2 from_hull(const Vec2& x) const { return {c * x.x() - s * x.y(), s * x.x() + c * x.y()}; }
  Vec2 to_hull(const Vec2& x) const { return {c * x.x() + s * x.y(), -s * x.x() + c * x.y()}; }
};

/// Moments of the solid below v = w, edge by edge: closed integrals of u dv, u^2 / 2 dv, u v dv
/// over the boundary cut to v <= w; the cut itself has dv = 0.
struct Immersed {
  double w;
  double area = 0, moment_u = 0, moment_v = 0;
  double line_0 = 0, line_1 = 0, line_2 = 0;  // moments of the waterplane about u = 0

  void add_edge(double weight, Vec2 a, Vec2 b) {
    if ((a.y() > w) != (b.y() > w)) {
      Vec2& above = a.y() > w ? a : b;
      const double u = a.x() + (w - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      const double side = b.y() > w ? weight : -weight;
      line_0 += side * u;
      line_1 += side * u * u / 2;
      line_2 += side * u * u * u / 3;
      above = {u, w};
    } else if (a.y() > w) {
      return;
    }
    const double dv = weight * (b.y() - a.y());
    area += dv * (a.x() + b.x()) / 2;
    moment_u += dv * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 6;
    moment_v += dv * (a.x() * (2 * a.y() + b.y()) + b.x() * (a.y() + 2 * b.y())) / 6;
  }
};

Immersed immerse(const std::vector<WeightedLoop>& solid, const Attitude& at) {
  const EarthAxes axes(at.heel);
  Immersed sum{at.waterline};
  for (const WeightedLoop& loop : solid) {
    Vec2 last = axes.from_hull(loop.points.back());
    for (const Vec2& x : loop.points) {
      const Vec2 next = axes.from_hull(x);
      sum.add_edge(loop.weight, last, next);
      last = next;
    }
  }
  return sum;
}

}  // namespace

Hydrostatics hydrostatics(const std::vector<WeightedLoop>& solid, const Attitude& at) {
  const Immersed sum = immerse(solid, at);
  Hydrostatics h;
  h.area = sum.area;
  h.waterplane_breadth = sum.line_0;
  if (sum.area > 0)
    h.buoyancy_centre = EarthAxes(at.heel).to_hull(Vec2(sum.moment_u, sum.moment_v) / sum.area);
  if (sum.line_0 > 0) {
    h.waterplane_centre = sum.line_1 / sum.line_0;
    h.waterplane_inertia = sum.line_2 - sum.line_1 * h.waterplane_centre;
  }
  if (sum.area > 0) h.bm = h.waterplane_inertia / sum.area;
  return h;
}

double metacentric_height(const std::vector<WeightedLoop>& solid, const Attitude& at,
                          const Vec2& cog) {
  const Hydrostatics h = hydrostatics(solid, at);
  return EarthAxes(at.heel).from_hull(h.buoyancy_centre - cog).y() + h.bm;
}

double roll_lever(const std::vector<WeightedLoop>& solid, const Attitude& at, const Vec2& cog) {
  const Hydrostatics h = hydrostatics(solid, at);
  return EarthAxes(at.heel).from_hull(h.buoyancy_centre - cog).x();
}

std::optional<double> find_waterline(const std::vector<WeightedLoop>& solid, double heel,
                                     double area) {
  SEAWAY_CHECK(area > 0, "displaced area {} m2; it must be positive", area);
  const EarthAxes axes(heel);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const WeightedLoop& loop : solid)
    for (const Vec2& x : loop.points) {
      const double v = axes.from_hull(x).y();
      low = std::min(low, v);
      high = std::max(high, v);
    }
  if (!(immerse(solid, {high, heel}).area > area)) return std::nullopt;
  double w = 0.5 * (low + high);
  for (int i = 0; i < 200 && high - low > 1e-13; ++i) {  // Newton, kept inside the bracket
    const Immersed sum = immerse(solid, {w, heel});
    (sum.area > area ? high : low) = w;
    const double step = sum.line_0 > 0 ? (area - sum.area) / sum.line_0 : 0.0;
    const double newton = w + step;
    if (std::abs(step) < 1e-14 && sum.line_0 > 0) return w;
    w = sum.line_0 > 0 && newton > low && newton < high && i % 3 != 2 ? newton : 0.5 * (low + high);
  }
  return w;
}

Equilibrium find_equilibrium(const std::vector<WeightedLoop>& solid, double area, const Vec2& cog,
                             bool free_heel) {
  Equilibrium result;
  const auto finish = [&](const Attitude& at, bool heel_found) {
    result.at = at;
    result.water = hydrostatics(solid, at);
    result.gm = metacentric_height(solid, at, cog);
    result.stable = heel_found && result.gm > 0;
    return result;
  };
  const auto upright = find_waterline(solid, 0.0, area);
  if (!upright) return result;
  result.floats = true;
  const Attitude start{*upright, 0.0};
  if (!free_heel) return finish(start, true);

  const auto lever = [&](double heel) {
    return roll_lever(solid, {find_waterline(solid, heel, area).value_or(start.waterline), heel},
                      cog);
  };
  constexpr double no_lever = 1e-10;  // [m]: rounding of the polygons (1e-9 m) makes less than this
  const double at_zero = roll_lever(solid, start, cog);
  if (std::abs(at_zero) < no_lever && metacentric_height(solid, start, cog) > 0)
    return finish(start, true);
  const double direction = std::abs(at_zero) < no_lever ? 1.0 : (at_zero > 0 ? 1.0 : -1.0);
  const double step = 0.5 * degree;
  double low = 0;
  for (int i = 1; i <= 160; ++i) {
    double high = direction * step * i;
    if (direction * lever(high) > 0) {
      low = high;
      continue;
    }
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (direction * lever(middle) > 0 ? low : high) = middle;
    }
    return finish({find_waterline(solid, low, area).value_or(start.waterline), low}, true);
  }
  return finish(start, false);
}

std::vector<std::pair<double, double>> righting_curve(const std::vector<WeightedLoop>& solid,
                                                      double area, const Vec2& cog,
                                                      const std::vector<double>& heels) {
  std::vector<std::pair<double, double>> curve;
  for (const double heel : heels)
    if (const auto w = find_waterline(solid, heel, area))
      curve.emplace_back(heel, -roll_lever(solid, {*w, heel}, cog));
  return curve;
}

}  // namespace seaway::hull
