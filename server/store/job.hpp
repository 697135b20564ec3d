// SPDX-License-Identifier: GPL-3.0-or-later
// What is stored of a job, and the table of its states and moves. Plain data; times are nanoseconds since
// 1970 (UTC) and only for people: order comes from numbers, never from clocks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seaway::store {

/// Numbers as in the schema (seaway.v1.Job.State); they are stored, so they never change.
enum class State { queued = 1, held = 2, running = 3, cancelling = 4, succeeded = 5, failed = 6, cancelled = 7 };

/// Numbers as in seaway.v1.Job.Reason.
enum class Reason {
  none = 0, diverged, nan, time_limit, memory, worker_crash, checkpoint_lost, invalid_input, disk_full, user,
  server_drain, executor_lost, server_restart, internal, stalled
};

std::string_view to_string(State state);
std::string_view to_string(Reason reason);
constexpr bool is_terminal(State s) {
  return s == State::succeeded || s == State::failed || s == State::cancelled;
}
/// The only moves there are; the store refuses all others.
bool may_move(State from, State to);

struct Progress {
  int stage = 0, stage_count = 0;
  double time = 0, fraction = 0, remaining_s = -1;
  bool held = false;
};

using Labels = std::map<std::string, std::string>;

struct Job {
  std::int64_t id = 0;  ///< order of creation
  std::string uid, request_id, title;
  State state = State::queued;
  Reason reason = Reason::none;
  std::string message;
  int attempt = 0;          ///< starts of the solver so far
  int stalled_attempts = 0; ///< attempts in a row that ended with the server, without a new sample
  int faults = 0;           ///< attempts in a row that ended by a fault of the worker, without a new sample
  std::int64_t run_ms = 0;  ///< computing time of all attempts
  std::string digest, code_version;
  std::string spec;         ///< opaque: case and files as submitted; empty in lists
  std::int64_t created_ns = 0, started_ns = 0, ended_ns = 0, updated_ns = 0;  ///< 0: not yet
  Progress progress;
  std::int64_t last_sequence = 0, checkpoint_sequence = 0;
  int priority = 0;
  Labels labels;
  std::string note;
  std::string base_uid;     ///< the job that this one repeats; empty: none
};

struct NewJob {
  std::string uid, request_id, title, digest, code_version, spec;
  int priority = 0;
  Labels labels{};
  std::string note{}, base_uid{};
  bool held = false;  ///< begins as HELD
};

/// What may change in any state.
struct JobUpdate {
  std::optional<int> priority;
  std::optional<Labels> labels;  ///< replaces all
  std::optional<std::string> note;
};

/// One change of a job; revisions have no gaps.
struct Change {
  std::int64_t revision = 0;
  std::string uid, kind;  ///< CREATED, STATE, UPDATED, DELETED
  State state = State::queued;
  std::int64_t time_ns = 0;
};
struct ChangeRange {
  std::int64_t first = 1, latest = 0;  ///< that are kept; none if latest < first
};

struct AuditRow {
  std::string principal, peer, method, target, outcome;
  std::int64_t time_ns = 0;
};

struct Channel {
  std::string name, unit;
  bool operator==(const Channel&) const = default;
};

struct Sample {
  std::int64_t sequence = 0;
  std::int32_t stage = 0;
  std::int64_t step = 0;
  double time = 0;
  std::vector<double> values;
};

/// Same bits (NaN equals itself, 0 differs from -0).
bool same_bits(const Sample& a, const Sample& b);

struct StageRow {
  int stage = 0;
  std::string report;  ///< opaque
};

/// A file of the solver from which the run can go on. `size`, `mtime_ns` and `inode` tell whether the file
/// on disk is still the one that was recorded.
struct Checkpoint {
  std::int64_t sequence = 0;
  std::string path;
  std::int64_t size = 0, mtime_ns = 0;
  std::uint64_t inode = 0;
};

struct Artifact {
  std::string name, path, media_type;
  std::int64_t size = 0, created_ns = 0;
};

struct Event {
  std::int64_t revision = 0, time_ns = 0;
  int attempt = 0;
  std::string kind, text;
};

}  // namespace seaway::store
