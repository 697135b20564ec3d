// SPDX-License-Identifier: GPL-3.0-or-later
// The threads that gRPC makes beside those that read from connections.
#pragma once

#include <chrono>

namespace seaway::rpc {

/// Makes gRPC start the threads of its executor (two for each core of the machine) and a second one for timers now, not when
/// it first needs them. gRPC 1.51 (Executor::Enqueue, start_timer_thread_and_unlock) counts a thread that the system refuses as
/// started. It hands work to it all the same: where two threads meet on a connection, a call on that connection would never be
/// answered, also when there are threads again. And it waits for the end of such a thread when it is shut down.
/// Something of gRPC must live before and after, or the threads end with the call. Throws Error(unavailable) if they
/// are not all at work within `patience`.
void start_call_threads(std::chrono::milliseconds patience);

}  // namespace seaway::rpc
