// SPDX-License-Identifier: GPL-3.0-or-later
// Input that cannot be accepted, field by field.
#pragma once

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/sim/check_case.hpp"

namespace seaway::convert {

/// ErrorCode invalid_argument; what() holds one line a problem, problems() the same by field path.
class InputError : public Error {
 public:
  InputError(std::string reason, std::vector<sim::Diagnostic> problems);
  const std::vector<sim::Diagnostic>& problems() const { return problems_; }
  /// For programs: INVALID_CASE, INVALID_REQUEST, REQUEST_ID_REUSED, ...
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
  std::vector<sim::Diagnostic> problems_;
};

/// `field: message; hint`
std::string to_text(const sim::Diagnostic& problem);

}  // namespace seaway::convert
