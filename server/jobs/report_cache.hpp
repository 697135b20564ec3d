// SPDX-License-Identifier: GPL-3.0-or-later
// The reports of the cases that were checked last. A check builds the hull and floats it, which takes milliseconds; the
// same case comes often: validated, then submitted, submitted again after a lost answer. Safe from any thread.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "seaway/v1/result.pb.h"

namespace seaway::jobs {

class ReportCache {
 public:
  explicit ReportCache(std::size_t capacity) : capacity_(capacity) {}
  /// `digest`: of case and files; the check depends on nothing else.
  std::optional<v1::CaseReport> find(const std::string& digest);
  /// Forgets the one that was not asked for the longest if there are too many.
  void keep(const std::string& digest, const v1::CaseReport& report);

 private:
  struct Entry {
    std::string digest;
    v1::CaseReport report;
  };
  const std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> entries_;                                     // guarded by mutex_; newest first
  std::map<std::string, std::list<Entry>::iterator> by_digest_;  // guarded by mutex_
};

}  // namespace seaway::jobs
