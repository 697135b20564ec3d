// SPDX-License-Identifier: GPL-3.0-or-later
// What the solver reports -> messages: radians become degrees here and nowhere else, so that the service,
// seaway-run and their files show the same bits.
#pragma once

#include <string>
#include <vector>

#include "core/sim/check_case.hpp"
#include "core/sim/run_observer.hpp"
#include "seaway/v1/job.pb.h"
#include "seaway/v1/result.pb.h"

namespace seaway::convert {

/// Unit as users see it: rad -> deg, rad/s -> deg/s; others unchanged.
std::string edge_unit(const std::string& unit);
/// The value of a channel with this core unit, in its edge unit.
double edge_value(const std::string& core_unit, double value);

v1::ChannelSchema to_proto(const sim::Channel& channel);
/// Appends one sample; the first one of a chunk sets its sequence and makes the columns.
void append(const sim::Sample& sample, const std::vector<sim::Channel>& channels, v1::SampleChunk& chunk);
v1::StageReport to_proto(const sim::StageInfo& info);
v1::StageReport to_proto(const sim::StageResult& result);
v1::Progress to_proto(const sim::Progress& progress);
v1::CaseReport to_proto(const sim::CaseReport& report);

}  // namespace seaway::convert
