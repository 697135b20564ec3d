// SPDX-License-Identifier: GPL-3.0-or-later
// Stored rows -> messages, and names and tokens out of requests.
#pragma once

#include <string>
#include <vector>

#include "seaway/v1/job_service.pb.h"
#include "server/store/job_store.hpp"

namespace seaway::rpc {

v1::Job to_proto(const store::Job& job);
v1::Progress to_proto(const store::Progress& progress);
v1::JobEvent to_proto(const store::Event& event);
v1::Artifact to_proto(const store::Artifact& artifact);
google::protobuf::RepeatedPtrField<v1::ChannelSchema> to_proto(const std::vector<store::Channel>& channels);
v1::SampleChunk to_proto(const std::vector<store::Sample>& samples, const std::vector<store::Channel>& channels);

void to_proto(const std::vector<store::EnvelopePoint>& points, const std::vector<store::Channel>& channels,
              v1::ReadEnvelopeResponse& out);

v1::Sweep to_proto(const store::Sweep& sweep, bool with_points);
/// The uid out of jobs/<uid> or sweeps/<uid>. Throws convert::InputError naming `field`.
std::string parse_job_name(const std::string& name, const std::string& field);
std::string parse_sweep_name(const std::string& name, const std::string& field);

/// Where a list goes on, tied to its filter.
std::string make_page_token(std::int64_t before_id, const store::ListQuery& filter);
/// 0 for an empty token. Throws convert::InputError for one that was not made for this list.
std::int64_t parse_page_token(const std::string& token, const store::ListQuery& filter);
/// As those, of the list of sweeps.
std::string make_sweep_token(std::int64_t before_id);
std::int64_t parse_sweep_token(const std::string& token);

[[noreturn]] void refuse_field(const std::string& field, const std::string& message, const std::string& hint);

}  // namespace seaway::rpc
