#include "core/base/version.hpp"

namespace seaway {

std::string_view code_version() { return SEAWAY_VERSION; }

}  // namespace seaway
