#include "core/hull/ship_hydrostatics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

/// Integrals over the part of the solid below the calm level, about a point in that level: the
/// waterplane itself then adds nothing to volume and moment, and need not be made.
struct Immersed {
  double volume = 0, wetted = 0;
  Vec3 moment = Vec3::Zero();
  double area = 0, area_x = 0, area_y = 0, area_xx = 0, area_yy = 0;

  void add_wet(double weight, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double v = weight * a.dot(b.cross(c)) / 6;
    volume += v;
    moment += 0.25 * v * (a + b + c);
    if (weight == 1) wetted += 0.5 * (b - a).cross(c - a).norm();
  }
  /// Edge of the waterplane, solid on its left.
  void add_edge(double weight, const Vec3& p, const Vec3& q) {
    const double cross = weight * (p.x() * q.y() - q.x() * p.y());
    area += cross / 2;
    area_x += cross * (p.x() + q.x()) / 6;
    area_y += cross * (p.y() + q.y()) / 6;
    area_xx += cross * (p.x() * p.x() + p.x() * q.x() + q.x() * q.x()) / 12;
    area_yy += cross * (p.y() * p.y() + p.y() * q.y() + q.y() * q.y()) / 12;
  }
  void add(double weight, const Vec3 (&x)[3]) {
    const bool wet[3] = {x[0].z() <= 0, x[1].z() <= 0, x[2].z() <= 0};
    const int n = wet[0] + wet[1] + wet[2];
    if (n == 0) return;
    if (n == 3) return add_wet(weight, x[0], x[1], x[2]);
    int lone = 0;  // the corner that is alone on its side
    while (wet[lone] != (n == 1)) ++lone;
    const Vec3 &a = x[lone], &b = x[(lone + 1) % 3], &c = x[(lone + 2) % 3];
    Vec3 p = a + a.z() / (a.z() - b.z()) * (b - a), q = a + a.z() / (a.z() - c.z()) * (c - a);
    p.z() = q.z() = 0;
    if (n == 1) {
      add_wet(weight, a, p, q);
      add_edge(weight, q, p);  // the wet part runs from p to q along the level
    } else {
      add_wet(weight, p, b, c);
      add_wet(weight, p, c, q);
      add_edge(weight, p, q);
    }
  }
};

Immersed immerse(const Solid& solid, const ShipAttitude& at) {
  const Eigen::Matrix3d turn = earth_from_hull(at);
  Immersed sum;
  std::vector<Vec3> x;
  for (const WeightedSurface& s : solid) {
    x.clear();
    for (const Vec3& v : s.surface.vertices) x.push_back(turn * v - Vec3(0, 0, at.waterline));
    for (const auto& t : s.surface.triangles) {
      const Vec3 corners[3] = {x[t[0]], x[t[1]], x[t[2]]};
      sum.add(s.weight, corners);
    }
  }
  return sum;
}

/// As find_waterline from a guess nearby: plain Newton, and the safe way if it does not settle.
std::optional<double> waterline_near(const Solid& solid, double heel, double trim, double volume,
                                     double guess) {
  double w = guess;
  for (int i = 0; i < 8; ++i) {
    const Immersed sum = immerse(solid, {w, heel, trim});
    if (!(sum.area > 0 && sum.volume > 0)) break;
    const double step = (volume - sum.volume) / sum.area;
    w += step;
    if (std::abs(step) < 1e-13 * (1 + std::abs(w))) return w;
  }
  return find_waterline(solid, heel, trim, volume);
}

/// Trim that balances the pitch moment at this heel, with its waterline; nullopt: sinks, or not
/// found.
std::optional<ShipAttitude> balance(const Solid& solid, double volume, const Vec3& cog, double heel,
                                    const std::optional<ShipAttitude>& near, bool free_trim) {
  double trim = near ? near->trim : 0;
  std::optional<double> w = near ? std::optional<double>(near->waterline) : std::nullopt;
  for (int i = 0; i < 60; ++i) {
    w = w ? waterline_near(solid, heel, trim, volume, *w)
          : find_waterline(solid, heel, trim, volume);
    if (!w) return std::nullopt;
    const ShipAttitude at{*w, heel, trim};
    if (!free_trim) return at;
    const ShipHydrostatics water = hydrostatics(solid, at);
    const double lever = levers(water, at, cog).x();
    const double gm = metacentric_heights(water, at, cog).longitudinal;
    if (std::abs(lever) < 1e-11 * (1 + std::abs(gm))) return at;
    // Newton: lever grows by GM_L for each radian bow down.
    const double step = gm > 0 ? -lever / gm : (lever > 0 ? -0.02 : 0.02);
    trim += std::clamp(step, -0.1, 0.1);
    if (std::abs(trim) > 30 * degree) return std::nullopt;
    if (std::abs(step) < 1e-13) return at;
  }
  return std::nullopt;
}

}  // namespace

Eigen::Matrix3d earth_from_hull(const ShipAttitude& at) {
  return (Eigen::AngleAxis<double>(at.trim, Vec3::UnitY()) *
          Eigen::AngleAxis<double>(at.heel, Vec3::UnitX()))
      .toRotationMatrix();
}

ShipHydrostatics hydrostatics(const Solid& solid, const ShipAttitude& at) {
  const Immersed sum = immerse(solid, at);
  ShipHydrostatics h;
  h.volume = sum.volume;
  h.wetted_surface = sum.wetted;
  h.waterplane_area = sum.area;
  if (sum.volume > 0)
    h.buoyancy_centre =
        earth_from_hull(at).transpose() * (sum.moment / sum.volume + Vec3(0, 0, at.waterline));
  if (sum.area > 0) {
    h.waterplane_centre = {sum.area_x / sum.area, sum.area_y / sum.area, at.waterline};
    h.inertia_transverse = sum.area_yy - sum.area_y * h.waterplane_centre.y();
    h.inertia_longitudinal = sum.area_xx - sum.area_x * h.waterplane_centre.x();
  }
  if (sum.volume > 0) {
    h.bm = h.inertia_transverse / sum.volume;
    h.bm_longitudinal = h.inertia_longitudinal / sum.volume;
  }
  return h;
}

Vec3 levers(const ShipHydrostatics& water, const ShipAttitude& at, const Vec3& cog) {
  return earth_from_hull(at) * (water.buoyancy_centre - cog);
}

MetacentricHeights metacentric_heights(const ShipHydrostatics& water, const ShipAttitude& at,
                                       const Vec3& cog) {
  const double above = levers(water, at, cog).z();
  return {above + water.bm, above + water.bm_longitudinal};
}

std::optional<double> find_waterline(const Solid& solid, double heel, double trim, double volume) {
  SEAWAY_CHECK(volume > 0, "displaced volume {} m3; it must be positive", volume);
  const Vec3 up = earth_from_hull({0, heel, trim}).row(2);
  double low = std::numeric_limits<double>::infinity(), high = -low, all = 0;
  for (const WeightedSurface& s : solid) {
    for (const Vec3& x : s.surface.vertices) {
      low = std::min(low, up.dot(x));
      high = std::max(high, up.dot(x));
    }
    all += s.weight * enclosed_volume(s.surface);
  }
  if (!(all > volume)) return std::nullopt;
  double w = 0.5 * (low + high);
  for (int i = 0; i < 200 && high - low > 1e-13; ++i) {  // Newton, kept inside the bracket
    const Immersed sum = immerse(solid, {w, heel, trim});
    (sum.volume > volume ? high : low) = w;
    const double step = sum.area > 0 ? (volume - sum.volume) / sum.area : 0.0;
    if (sum.area > 0 && std::abs(step) < 1e-14 * (1 + std::abs(w))) return w;
    const double newton = w + step;
    w = sum.area > 0 && newton > low && newton < high && i % 4 != 3 ? newton : 0.5 * (low + high);
  }
  return w;
}

ShipEquilibrium find_equilibrium(const Solid& solid, double volume, const Vec3& cog, bool free_heel,
                                 bool free_trim) {
  ShipEquilibrium result;
  const auto finish = [&](const ShipAttitude& at, bool heel_found) {
    result.at = at;
    result.water = hydrostatics(solid, at);
    result.gm = metacentric_heights(result.water, at, cog);
    result.stable = heel_found && result.gm.transverse > 0;
    return result;
  };
  const auto upright = balance(solid, volume, cog, 0, std::nullopt, free_trim);
  if (!upright) return result;
  result.floats = true;
  if (!free_heel) return finish(*upright, true);

  ShipAttitude last = *upright;  // the next one is near
  const auto lever = [&](double heel, ShipAttitude* where = nullptr) {
    last = balance(solid, volume, cog, heel, last, free_trim)
               .value_or(ShipAttitude{upright->waterline, heel, last.trim});
    if (where != nullptr) *where = last;
    return levers(hydrostatics(solid, last), last, cog).y();
  };
  const auto water = hydrostatics(solid, *upright);
  const double at_zero = levers(water, *upright, cog).y();
  const double no_lever = 1e-9 * std::max(1e-3, std::sqrt(water.waterplane_area));
  if (std::abs(at_zero) < no_lever && metacentric_heights(water, *upright, cog).transverse > 0)
    return finish(*upright, true);
  const double direction = std::abs(at_zero) < no_lever || at_zero > 0 ? 1.0 : -1.0;
  const double step = 1.0 * degree;
  double low = 0;
  for (int i = 1; i <= 80; ++i) {
    double high = direction * step * i;
    if (direction * lever(high) > 0) {
      low = high;
      continue;
    }
    for (int k = 0; k < 44; ++k) {
      const double middle = 0.5 * (low + high);
      (direction * lever(middle) > 0 ? low : high) = middle;
    }
    ShipAttitude at;
    lever(low, &at);
    return finish(at, true);
  }
  return finish(*upright, false);
}

std::vector<std::pair<double, double>> righting_curve(const Solid& solid, double volume,
                                                      const Vec3& cog,
                                                      const std::vector<double>& heels,
                                                      bool free_trim) {
  std::vector<std::pair<double, double>> curve;
  std::optional<ShipAttitude> last;
  for (const double heel : heels) {
    const auto at = balance(solid, volume, cog, heel, last, free_trim);
    if (!at) continue;
    last = at;
    curve.emplace_back(heel, -levers(hydrostatics(solid, *at), *at, cog).y());
  }
  return curve;
}

}  // namespace seaway::hull
