// The one exception type of the project, and the checks that throw it.
// Exceptions are for failures; outcomes (cancelled, not converged) are return values.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace seaway {

/// What kind of failure; server/rpc maps each to a gRPC status in one place.
enum class ErrorCode {
  invalid_argument,     ///< the user's input is wrong; the message says what to do
  not_found,            ///< a named thing does not exist
  failed_precondition,  ///< right request, wrong state
  unavailable,          ///< try again later
  resource_exhausted,   ///< a limit or quota was reached
  data_loss,            ///< stored data is corrupt
  diverged,             ///< the solution blew up; the last good state was kept
  internal,             ///< our own mistake
};

std::string_view to_string(ErrorCode code);

/// `message` names the thing, its value, what is allowed and what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

template <class... Args>
[[noreturn]] void fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace seaway

/// For what the user or the world did: always on, throws Error(invalid_argument).
#define SEAWAY_CHECK(condition, ...)                                             \
  do {                                                                           \
    if (!(condition)) ::seaway::fail(::seaway::ErrorCode::invalid_argument, __VA_ARGS__); \
  } while (false)

/// For our own mistakes: on in debug and audit builds, aborts.
#ifdef SEAWAY_ENABLE_ASSERT
#include <cstdio>
#include <cstdlib>
#define SEAWAY_ASSERT(condition)                                                         \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                      \
    }                                                                                    \
  } while (false)
#else
#define SEAWAY_ASSERT(condition) ((void)0)
#endif
