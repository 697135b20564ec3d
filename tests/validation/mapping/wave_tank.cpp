#include "tests/validation/mapping/wave_tank.hpp"

#include <cmath>

#include "core/base/constants.hpp"
#include "core/field/restrict.hpp"
#include "tests/unit/core/transfer/meshes.hpp"

namespace seaway::validation {
namespace {

using field::offset;
using mesh::BlockShape;
using mesh::Forest;

constexpr double gravity = 9.81, rho_water = 1000, rho_air = 1.2;
const double wave_number = 2 * pi / wave_length;
const double omega = std::sqrt(gravity * wave_number);
const double amplitude = 0.5 * wave_height;

mesh::TankGrid<2> tank(double base) {
  return mesh::make_tank_grid<2>(Vec2(0, -0.6 * wave_length), Vec2(wave_length, 0.4 * wave_length), base,
                                 {true, false});
}

mesh::Forest<2> build(double base, const std::vector<mesh::RefinedBox<2>>& boxes, int threads) {
  const auto grid = tank(base);
  return Forest<2>(grid, mesh::finest_level<2>(grid, boxes), mesh::refine_boxes<2>(grid, boxes), threads);
}

/// Weight of the air at a height above the surface.
double air_share(double height) { return 0.5 * (1 + std::tanh(height / (0.01 * wave_length))); }

/// Stream function of the vortex in the water: core 0.03 lengths.
double vortex(const Vec2& x) {
  const double core = 0.03 * wave_length;
  const Vec2 d = x - Vec2(0.5 * wave_length, -0.08 * wave_length);
  return 0.1 * amplitude * omega * core * std::exp(-d.squaredNorm() / (core * core));
}

double stream_function(const Vec2& x) {
  const double phase = std::cos(wave_number * x[0]);
  const double c = amplitude * omega / wave_number;
  return c * phase * std::exp(-wave_number * std::abs(x[1])) + vortex(x);
}

}  // namespace

mesh::Forest<2> coarse_stage(double base, int levels, int threads) {
  const double h = std::ldexp(base, -levels);
  return build(base, {{Vec2(0, -0.07), Vec2(wave_length, 0.07), h},
                      {Vec2(0.1, -0.9), Vec2(0.5, -0.5), 2 * h}}, threads);
}

mesh::Forest<2> fine_stage(double base, int levels, int threads) {
  const double h = std::ldexp(base, -levels);
  return build(base, {{Vec2(0, -0.06), Vec2(wave_length, 0.06), 0.5 * h},
                      {Vec2(1.3, -0.4), Vec2(1.8, 0.1), 0.5 * h}}, threads);
}

double wave_elevation(double x) { return amplitude * std::cos(wave_number * x); }

double wave_velocity(const Vec2& x, int axis) {
  const double b = air_share(x[1] - wave_elevation(x[0]));
  const double water = std::exp(wave_number * std::min(x[1], 2 * amplitude));
  const double air = std::exp(-wave_number * std::max(x[1], -2 * amplitude));
  const double s = amplitude * omega;
  const double core = 0.03 * wave_length;
  const Vec2 d = x - Vec2(0.5 * wave_length, -0.08 * wave_length);
  if (axis == 0) {
    const double swirl = -2 * d[1] / (core * core) * vortex(x);
    return s * std::cos(wave_number * x[0]) * ((1 - b) * water - b * air) + swirl;
  }
  const double swirl = 2 * d[0] / (core * core) * vortex(x);
  return s * std::sin(wave_number * x[0]) * ((1 - b) * water + b * air) + swirl;
}

double wave_pressure(const Vec2& x) {
  const double eta = wave_elevation(x[0]);
  if (x[1] > eta) return -rho_air * gravity * (x[1] - eta);
  return rho_water * gravity * (eta * std::exp(wave_number * (x[1] - eta)) - x[1]);
}

transfer::FlowFields<2> exact_flow(const mesh::Forest<2>& forest) {
  using namespace transfer::testing;
  transfer::FlowFields<2> f;
  fill_water<2>(forest, [](const Vec2& x) { return wave_elevation(x[0]); }, f.vof);
  fill_cells<2>(forest, [](const Vec2& x) { return wave_pressure(x); }, f.p);
  f.extra.resize(1);
  fill_cells<2>(forest, [](const Vec2& x) {
    return std::exp(-(x[1] + 0.6 * wave_length) / (0.05 * wave_length));
  }, f.extra[0]);
  fill_faces<2>(forest, [](const Vec2& x, int axis) { return wave_velocity(x, axis); }, f.u);
  f.w = transfer::FaceField<double, 2>(forest);
  for (const int b : forest.leaves()) {
    const auto& block = forest.block(b);
    for (int axis = 0; axis < 2; ++axis) {
      field::for_box<2>(field::filled<2>(0), field::faces_upper<2>(axis), [&](const IVec<2>& i) {
        const int across = 1 - axis;
        Vec2 low = block.face_centre(i, axis), high = low;
        low[across] -= 0.5 * block.h[across];
        high[across] += 0.5 * block.h[across];
        const double change = (stream_function(high) - stream_function(low)) / block.h[across];
        f.w.block(axis, b)[offset<2>(i, field::face_strides<2>(axis))] = axis == 0 ? change : -change;
      });
    }
  }
  field::restrict_faces(forest, f.u);
  field::restrict_faces(forest, f.w);
  return f;
}

}  // namespace seaway::validation
