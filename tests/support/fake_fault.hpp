// SPDX-License-Identifier: GPL-3.0-or-later
// What can go wrong in a solver's process, on purpose. A case with the words "fault KIND@N" or "fault KIND@NxM"
// in its title breaks before its sample N, in the first M attempts that come there (default: in all).
// KIND: segv, fpe, abort, exit, hang (computes without end), sleep (the process is stopped), memory, disk,
// deaf (goes on, but does not stop when asked to), throw.
#pragma once

#include <cstdint>
#include <string>

namespace seaway::testing {

class FakeFault {
 public:
  FakeFault() = default;
  /// `folder`: of the run; the attempts are counted in a file beside it.
  FakeFault(const std::string& title, const std::string& folder);
  /// Before each sample. May not return.
  void before(std::int64_t sequence);
  /// False: stop requests are not to be looked at.
  bool listens() const { return !deaf_; }

 private:
  void strike();
  std::string kind_, folder_;
  std::int64_t at_ = 0;
  int times_ = 0;  ///< 0: always
  bool deaf_ = false;
};

}  // namespace seaway::testing
