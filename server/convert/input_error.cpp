// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/convert/input_error.hpp"

namespace seaway::convert {
namespace {

std::string all_text(const std::vector<sim::Diagnostic>& problems) {
  std::string out;
  for (const sim::Diagnostic& problem : problems) {
    if (!out.empty()) out += '\n';
    out += to_text(problem);
  }
  return out;
}

}  // namespace

InputError::InputError(std::string reason, std::vector<sim::Diagnostic> problems)
    : Error(ErrorCode::invalid_argument, all_text(problems)),
      reason_(std::move(reason)),
      problems_(std::move(problems)) {}

std::string to_text(const sim::Diagnostic& problem) {
  std::string out = problem.field;
  if (!out.empty()) out += ": ";
  out += problem.message;
  if (!problem.hint.empty()) out += "; " + problem.hint;
  return out;
}

}  // namespace seaway::convert
