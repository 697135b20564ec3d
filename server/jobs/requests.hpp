// SPDX-License-Identifier: GPL-3.0-or-later
// What requests have in common: request ids, and what a user may hang on a job.
#pragma once

#include <string>

#include "server/store/job.hpp"

namespace seaway::jobs {

/// Throws convert::InputError for one field.
[[noreturn]] void refuse(const std::string& reason, const std::string& field, const std::string& message,
                         const std::string& hint);

/// Nothing that steers a terminal: no control characters, not even the end of a line.
bool is_text(const std::string& text);
bool is_uuid(const std::string& text);
std::string lower(std::string text);

/// Labels that a job may have. Throws InputError naming `field`.
void check_labels(const std::string& field, const store::Labels& labels);
/// Throws convert::InputError for a priority, labels or a note that are not allowed. `path` goes before the names of the
/// fields.
void check_traits(const std::string& path, int priority, const store::Labels& labels, const std::string& note);

}  // namespace seaway::jobs
