// SPDX-License-Identifier: GPL-3.0-or-later
// seawayd backup, seawayd verify and seawayd audit: also while a server runs on the same data.
#pragma once

#include <string>

namespace seaway::server {

/// Copies the database of a data folder to a new file. Prints what it did; 0, or throws.
int backup(const std::string& data_dir, const std::string& to);

/// Reads everything in the database of a data folder; prints what is wrong. 0: nothing, 1: something.
int verify(const std::string& data_dir);

/// Prints the last `rows` of the audit trail, oldest first: time (UTC), principal, peer, method, outcome, target. 0, or throws.
int audit(const std::string& data_dir, int rows, bool only_denied);

}  // namespace seaway::server
