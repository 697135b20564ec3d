// The version of the code; stored with every result.
#pragma once

#include <string_view>

namespace seaway {

std::string_view code_version();

}  // namespace seaway
