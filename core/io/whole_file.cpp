#include "core/io/whole_file.hpp"

#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"

namespace seaway::io {

void write_whole_file(const std::string& path, std::initializer_list<std::string_view> pieces) {
  const std::string aside = path + ".part";
  {
    std::ofstream file(aside, std::ios::binary);
    for (const std::string_view piece : pieces) file << piece;
    if (!file.flush()) fail(ErrorCode::unavailable, "cannot write {}", path);
  }
  std::filesystem::rename(aside, path);
}

}  // namespace seaway::io
