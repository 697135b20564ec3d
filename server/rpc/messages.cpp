// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/messages.hpp"

#include <fmt/format.h>

#include <charconv>

#include "server/convert/input_error.hpp"
#include "server/convert/result.hpp"
#include "server/jobs/queue.hpp"

namespace seaway::rpc {
namespace {

void put_time(std::int64_t ns, google::protobuf::Timestamp& out) {
  out.set_seconds(ns / 1'000'000'000);
  out.set_nanos(static_cast<std::int32_t>(ns % 1'000'000'000));
}

/// What a place belongs to: it tells one filter from another, and a place from one that somebody has thought up.
unsigned token_key(std::int64_t before_id, const store::ListQuery& filter) {
  unsigned key = static_cast<unsigned>(before_id) * 2654435761u;  // Knuth's multiplicative hash
  unsigned states = 0;
  for (const store::State s : filter.states) states |= 1u << static_cast<unsigned>(s);
  key = key * 16777619u ^ states;
  for (const auto& [name, value] : filter.labels)
    key = key * 16777619u ^ static_cast<unsigned>(std::hash<std::string>{}(name + '\n' + value));
  return key;
}

/// There is one way to write each token, and `make` knows it.
template <class Make>
std::int64_t parse_token(const std::string& token, Make make) {
  if (token.empty()) return 0;
  std::int64_t id = 0;
  std::from_chars(token.data() + (token[0] == 's' ? 1 : 0), token.data() + token.size(), id, 16);
  if (id <= 0 || token != make(id))
    refuse_field("page_token", "does not belong to this list", "use next_page_token of the page before, with the same filter");
  return id;
}

}  // namespace

v1::Progress to_proto(const store::Progress& p) {
  return convert::to_proto(sim::Progress{p.stage, p.stage_count, p.time, p.fraction, p.remaining_s, p.held});
}

v1::Job to_proto(const store::Job& job) {
  v1::Job m;
  m.set_name("jobs/" + job.uid);
  m.set_uid(job.uid);
  m.set_title(job.title);
  m.set_state(static_cast<v1::Job::State>(job.state));
  m.set_state_reason(static_cast<v1::Job::Reason>(job.reason));
  m.set_state_message(job.message);
  *m.mutable_progress() = to_proto(job.progress);
  m.set_attempt(job.attempt);
  put_time(job.created_ns, *m.mutable_create_time());
  if (job.started_ns > 0) put_time(job.started_ns, *m.mutable_start_time());
  if (job.ended_ns > 0) put_time(job.ended_ns, *m.mutable_end_time());
  put_time(job.updated_ns, *m.mutable_update_time());
  m.set_spec_digest(job.digest);
  m.set_code_version(job.code_version);
  m.set_latest_sequence(job.last_sequence);
  m.set_checkpoint_sequence(job.checkpoint_sequence);
  m.set_priority(job.priority);
  for (const auto& [key, value] : job.labels) (*m.mutable_labels())[key] = value;
  m.set_note(job.note);
  if (!job.base_uid.empty()) m.set_base_job("jobs/" + job.base_uid);
  m.set_run_s(1e-3 * static_cast<double>(job.run_ms));
  m.set_fault_count(job.faults);
  return m;
}

v1::Sweep to_proto(const store::Sweep& sweep, bool with_points) {
  v1::Sweep m;
  m.set_name("sweeps/" + sweep.uid);
  m.set_uid(sweep.uid);
  m.set_title(sweep.title);
  put_time(sweep.created_ns, *m.mutable_create_time());
  m.set_spec_digest(sweep.digest);
  m.set_code_version(sweep.code_version);
  m.set_job_count(static_cast<int>(sweep.members.size()));
  for (int state = v1::Job::STATE_QUEUED; state <= v1::Job::STATE_CANCELLED; ++state) m.add_state_counts(0);
  m.set_ended(true);
  for (const store::SweepMember& member : sweep.members) {
    if (member.exists) {
      const int at = static_cast<int>(member.state) - v1::Job::STATE_QUEUED;
      m.set_state_counts(at, m.state_counts(at) + 1);
      if (!store::is_terminal(member.state)) m.set_ended(false);
    }
    if (!with_points) continue;
    v1::SweepPoint& point = *m.add_points();
    point.set_job("jobs/" + member.uid);
    point.set_case_name(member.point.case_name);
    point.set_period_s(member.point.period_s);
    point.set_height_m(member.point.height_m);
    point.set_heading_deg(member.point.heading_deg);
    if (!member.exists) continue;
    point.set_state(static_cast<v1::Job::State>(member.state));
    point.set_fraction(member.fraction);
  }
  return m;
}

v1::JobEvent to_proto(const store::Event& event) {
  v1::JobEvent m;
  m.set_revision(event.revision);
  put_time(event.time_ns, *m.mutable_time());
  m.set_attempt(event.attempt);
  m.set_kind(event.kind);
  m.set_text(event.text);
  return m;
}

v1::Artifact to_proto(const store::Artifact& artifact) {
  v1::Artifact m;
  m.set_name(artifact.name);
  m.set_media_type(artifact.media_type);
  m.set_size_bytes(artifact.size);
  put_time(artifact.created_ns, *m.mutable_create_time());
  return m;
}

google::protobuf::RepeatedPtrField<v1::ChannelSchema> to_proto(const std::vector<store::Channel>& channels) {
  google::protobuf::RepeatedPtrField<v1::ChannelSchema> out;
  for (const store::Channel& c : channels) *out.Add() = convert::to_proto(sim::Channel{c.name, c.unit});
  return out;
}

v1::SampleChunk to_proto(const std::vector<store::Sample>& samples, const std::vector<store::Channel>& channels) {
  v1::SampleChunk chunk;
  if (samples.empty()) return chunk;
  const auto n = static_cast<int>(samples.size());
  chunk.set_first_sequence(samples.front().sequence);
  chunk.mutable_stages()->Reserve(n);
  chunk.mutable_steps()->Reserve(n);
  chunk.mutable_times_s()->Reserve(n);
  for (const store::Sample& s : samples) {
    chunk.add_stages(s.stage);
    chunk.add_steps(s.step);
    chunk.add_times_s(s.time);
  }
  for (std::size_t c = 0; c < channels.size(); ++c) {
    auto& values = *chunk.add_columns()->mutable_values();
    values.Reserve(n);
    for (const store::Sample& s : samples) values.Add(convert::edge_value(channels[c].unit, s.values.at(c)));
  }
  return chunk;
}

void to_proto(const std::vector<store::EnvelopePoint>& points, const std::vector<store::Channel>& channels,
              v1::ReadEnvelopeResponse& out) {
  for (const store::EnvelopePoint& p : points) {
    out.add_first_sequences(p.first);
    out.add_times_s(p.time);
    out.set_last_sequence(p.last);
  }
  for (std::size_t c = 0; c < channels.size(); ++c) {
    auto& column = *out.add_columns();
    for (const store::EnvelopePoint& p : points) {
      column.add_minimum(convert::edge_value(channels[c].unit, p.minimum.at(c)));
      column.add_maximum(convert::edge_value(channels[c].unit, p.maximum.at(c)));
    }
  }
}

void refuse_field(const std::string& field, const std::string& message, const std::string& hint) {
  throw convert::InputError("INVALID_REQUEST", {{sim::Diagnostic::Severity::error, field, message, hint}});
}

std::string parse_sweep_name(const std::string& name, const std::string& field) {
  if (!name.starts_with("sweeps/") || !jobs::is_uid(name.substr(7)))
    refuse_field(field, name.empty() ? "is missing" : "is not the name of a sweep", "write sweeps/ and the uid");
  return name.substr(7);
}

std::string parse_job_name(const std::string& name, const std::string& field) {
  if (!name.starts_with("jobs/") || !jobs::is_uid(name.substr(5)))
    refuse_field(field, name.empty() ? "is missing" : "is not the name of a job", "write jobs/ and the uid");
  return name.substr(5);
}

std::string make_page_token(std::int64_t before_id, const store::ListQuery& filter) {
  return fmt::format("{:x}-{:x}", before_id, token_key(before_id, filter));
}

std::int64_t parse_page_token(const std::string& token, const store::ListQuery& filter) {
  return parse_token(token, [&](std::int64_t id) { return make_page_token(id, filter); });
}

std::string make_sweep_token(std::int64_t before_id) { return fmt::format("s{}", make_page_token(before_id, {})); }

std::int64_t parse_sweep_token(const std::string& token) { return parse_token(token, make_sweep_token); }

}  // namespace seaway::rpc
