// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a case, each read by one function; private to server/convert.
#pragma once

#include <google/protobuf/repeated_field.h>

#include <string>

#include "core/sim/case.hpp"
#include "seaway/v1/case.pb.h"
#include "server/convert/checker.hpp"

namespace seaway::convert {

using Extent = google::protobuf::RepeatedField<double>;

/// [lower, upper] pairs into two corners. In 2-D x must be left out.
void read_box(const Extent& x, const Extent& y, const Extent& z, const std::string& path, int dim, Vec3& lower,
              Vec3& upper, Checker& check);

/// The step's length or the steps in a period, of a case's or a stage's time (v1::TimeControl, v1::StageTime), into
/// `time`.dt and `time`.steps_per_period.
template <class Message, class Time>
void read_time_step(const Message& m, const std::string& path, Time& time, Checker& check) {
  if (m.has_dt_s() && m.has_steps_per_period())
    check.problem(path + ".steps_per_period", "has no effect beside " + path + ".dt_s", "keep one of them");
  if (m.has_dt_s()) time.dt = check.number(path + ".dt_s", m.dt_s(), positive);
  if (m.has_steps_per_period())
    time.steps_per_period = check.number(path + ".steps_per_period", m.steps_per_period(), {10, 1e5});
}

Vec3 read_vector(const v1::Vector& v);
void put_wave(const sim::Wave& wave, v1::Wave& message);
bool dof_exists(sim::Dof dof, int dim);

void read_wave(const v1::Wave& message, int dim, sim::Wave& wave, Checker& check);
void read_hull(const v1::Hull& message, int dim, sim::Hull& hull, Checker& check);
void read_body(const v1::Case& message, sim::Body& body, Checker& check);
void read_turbulence(const v1::Turbulence& message, sim::Turbulence& turbulence, Checker& check);
void read_no_slip(const v1::Tank& message, int dim, sim::Tank& tank, Checker& check);
void put_turbulence(const sim::Turbulence& turbulence, v1::Turbulence& message);
void put_no_slip(const sim::Tank& tank, int dim, v1::Tank& message);
void read_cascade(const v1::Cascade& message, int dim, std::vector<sim::Stage>& stages, Checker& check);

}  // namespace seaway::convert
