// SPDX-License-Identifier: GPL-3.0-or-later
// Turbulence model and no-slip sides of the tank.
#include <fmt/format.h>

#include "server/convert/case_parts.hpp"

namespace seaway::convert {

void read_turbulence(const v1::Turbulence& m, sim::Turbulence& t, Checker& check) {
  using Model = sim::Turbulence::Model;
  using Walls = sim::Turbulence::Walls;
  t.model = m.model() == v1::Turbulence::MODEL_UNSPECIFIED ? Model::stabilised : static_cast<Model>(m.model());
  const bool laminar = t.model == Model::laminar;
  t.walls = laminar ? Walls::slip : Walls::wall_function;
  if (m.walls() != v1::Turbulence::WALLS_UNSPECIFIED) t.walls = static_cast<Walls>(m.walls() - 1);
  for (const auto& [given, name] : {std::pair{m.has_intensity(), "intensity"}, {m.has_velocity_m_per_s(), "velocity_m_per_s"},
                                    {m.has_length_scale_m(), "length_scale_m"}})
    if (given && laminar) check.problem(std::string("turbulence.") + name, "has no effect with model: laminar", "remove it");
  if (m.has_intensity()) t.intensity = check.number("turbulence.intensity", m.intensity(), {0, 1, true});
  if (m.has_velocity_m_per_s())
    t.velocity = check.number("turbulence.velocity_m_per_s", m.velocity_m_per_s(), positive);
  if (m.has_length_scale_m())
    t.length_scale = check.number("turbulence.length_scale_m", m.length_scale_m(), positive);
  if (m.has_buoyancy()) t.buoyancy = m.buoyancy();
}

void read_no_slip(const v1::Tank& m, int dim, sim::Tank& tank, Checker& check) {
  check.entries("tank.no_slip", m.no_slip_size(), 0, 6);
  for (int i = 0; i < m.no_slip_size(); ++i) {
    const v1::NoSlipSide& from = m.no_slip(i);
    const std::string path = fmt::format("tank.no_slip[{}]", i);
    if (from.side() == v1::TANK_SIDE_UNSPECIFIED) {
      check.problem(path + ".side", "is missing", "write bottom, lid, y_lower, ...");
      continue;
    }
    sim::Tank::NoSlip to;
    to.axis = (from.side() - 1) / 2;
    to.upper = from.side() % 2 == 0;
    if (dim == 2 && from.has_velocity_x_m_per_s())
      check.problem(path + ".velocity_x_m_per_s", "x does not exist in 2-D", "remove it");
    to.velocity = {from.velocity_x_m_per_s(), from.velocity_y_m_per_s(), from.velocity_z_m_per_s()};
    tank.no_slip.push_back(to);
  }
}

void put_turbulence(const sim::Turbulence& t, v1::Turbulence& m) {
  m.set_model(static_cast<v1::Turbulence::Model>(static_cast<int>(t.model)));
  m.set_walls(static_cast<v1::Turbulence::Walls>(static_cast<int>(t.walls) + 1));
  if (!t.has_k_epsilon()) return;
  m.set_intensity(t.intensity);
  if (t.velocity > 0) m.set_velocity_m_per_s(t.velocity);
  m.set_length_scale_m(t.length_scale);
  m.set_buoyancy(t.buoyancy);
}

void put_no_slip(const sim::Tank& tank, int dim, v1::Tank& m) {
  for (const sim::Tank::NoSlip& from : tank.no_slip) {
    v1::NoSlipSide& to = *m.add_no_slip();
    to.set_side(static_cast<v1::TankSide>(2 * from.axis + (from.upper ? 2 : 1)));
    if (dim == 3) to.set_velocity_x_m_per_s(from.velocity.x());
    to.set_velocity_y_m_per_s(from.velocity.y());
    to.set_velocity_z_m_per_s(from.velocity.z());
  }
}

}  // namespace seaway::convert
