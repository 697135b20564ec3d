// Files that are there whole or not at all: results that a reader may open at any time.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace seaway::io {

/// The pieces one after the other, written aside and renamed. Not synced: checkpoints, which must survive a power
/// loss, write themselves. Throws Error(unavailable) if it cannot be written.
void write_whole_file(const std::string& path, std::initializer_list<std::string_view> pieces);

}  // namespace seaway::io
