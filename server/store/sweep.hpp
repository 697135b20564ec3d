// SPDX-License-Identifier: GPL-3.0-or-later
// What is stored of a sweep: many jobs out of one request. Plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/store/job.hpp"

namespace seaway::store {

/// What is particular about one job of a sweep.
struct SweepPoint {
  std::string case_name;
  double period_s = 0, height_m = 0, heading_deg = 0;
};

struct NewSweep {
  std::string uid, request_id, title, digest, code_version;
  std::string spec;  ///< opaque: the request as asked for
  std::vector<NewJob> jobs;
  std::vector<SweepPoint> points;  ///< one for each job
};

struct SweepMember {
  SweepPoint point;
  std::string uid;
  bool exists = false;  ///< false: the job has been deleted; what follows means nothing then
  State state = State::queued;
  double fraction = 0;
};

struct Sweep {
  std::int64_t id = 0;  ///< order of creation
  std::string uid, request_id, title, digest, code_version;
  std::string spec;  ///< empty in lists
  std::int64_t created_ns = 0;
  std::vector<SweepMember> members;  ///< in the order of the request
};

struct CreatedSweep {
  Sweep sweep;
  bool existed = false;  ///< the request id was known; `sweep` is the old one, whatever its digest
};

}  // namespace seaway::store
