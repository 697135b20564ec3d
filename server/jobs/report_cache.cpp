// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/report_cache.hpp"

namespace seaway::jobs {

std::optional<v1::CaseReport> ReportCache::find(const std::string& digest) {
  const std::lock_guard lock(mutex_);
  const auto found = by_digest_.find(digest);
  if (found == by_digest_.end()) return std::nullopt;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->report;
}

void ReportCache::keep(const std::string& digest, const v1::CaseReport& report) {
  const std::lock_guard lock(mutex_);
  if (by_digest_.count(digest) > 0) return;  // two threads have checked the same case
  entries_.push_front({digest, report});
  by_digest_[digest] = entries_.begin();
  if (entries_.size() <= capacity_) return;
  by_digest_.erase(entries_.back().digest);
  entries_.pop_back();
}

}  // namespace seaway::jobs
