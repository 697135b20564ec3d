// SPDX-License-Identifier: GPL-3.0-or-later
// Collects what is wrong with the fields of a message, so that a user sees all of it at once.
#pragma once

#include <google/protobuf/message.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/sim/check_case.hpp"

namespace seaway::convert {

/// Allowed values of a number. The ends belong to it unless an open end is asked for.
struct Range {
  double lower = -1e12;
  double upper = 1e12;
  bool above_lower = false;  ///< value > lower
};
inline constexpr Range positive{0, 1e12, true};
inline constexpr Range not_negative{0, 1e12, false};
inline constexpr Range any_finite{};

class Checker {
 public:
  void problem(const std::string& field, std::string message, std::string hint = "");
  /// `value`, complained about if it lies outside; NaN always does.
  double number(const std::string& field, double value, Range range);
  int count(const std::string& field, int value, int lower, int upper);
  /// A name that becomes part of channel and file names.
  void name(const std::string& field, const std::string& value);
  /// One line of at most `most` bytes that may be shown on a terminal; may be empty.
  void line(const std::string& field, const std::string& value, std::size_t most);
  void entries(const std::string& field, int n, int lower, int upper);
  /// Every number of the message and of those inside it is finite, every enumerator known.
  void finite(const google::protobuf::Message& message, const std::string& path = "");
  bool ok() const { return problems_.empty(); }
  std::vector<sim::Diagnostic> take() { return std::move(problems_); }

 private:
  std::vector<sim::Diagnostic> problems_;
};

}  // namespace seaway::convert
