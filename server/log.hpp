// SPDX-License-Identifier: GPL-3.0-or-later
// The log of seawayd.
#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

namespace seaway::server {

/// Writes to `file`; empty: to standard error. One line for each message, whatever its text: control characters, which a text
/// of a client or of a solver may have, come as \n or \x1b, so that nobody writes lines of his own. Throws spdlog::spdlog_ex
/// for a file that cannot be written.
std::shared_ptr<spdlog::logger> make_log(const std::string& file, const std::string& level);

}  // namespace seaway::server
