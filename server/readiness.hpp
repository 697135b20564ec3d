// SPDX-License-Identifier: GPL-3.0-or-later
// What systemd wants to hear of a service (Type=notify): sd_notify(3) without its library.
#pragma once

#include <string>

namespace seaway::server {

/// Sends `state`, "READY=1" or "STOPPING=1", to the socket that NOTIFY_SOCKET names; nothing if there is none, or if nobody
/// listens there.
void notify_manager(const std::string& state);

}  // namespace seaway::server
