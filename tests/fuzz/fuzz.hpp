// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets share. A target returns for every input; what a parser may say of a wrong one is caught by type,
// and anything else ends the program.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace seaway::fuzz {

/// A property that must hold whatever the input is.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

/// The input as a file, for readers that want a path; in memory.
class InputFile {
 public:
  explicit InputFile(std::string_view bytes) : fd_(::memfd_create("input", MFD_CLOEXEC)) {
    require(fd_ >= 0 && ::write(fd_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()), "no memory file");
  }
  ~InputFile() { ::close(fd_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

/// Takes a part off the front: its length in two bytes, the small one first, and as many bytes as there are.
inline std::string take_part(std::string_view& rest) {
  if (rest.size() < 2) return {};
  const std::size_t n = static_cast<unsigned char>(rest[0]) + 256u * static_cast<unsigned char>(rest[1]);
  const std::string part(rest.substr(2, n));
  rest.remove_prefix(2 + part.size());
  return part;
}
inline std::string make_part(const std::string& bytes) {
  return std::string{static_cast<char>(bytes.size() % 256), static_cast<char>(bytes.size() / 256)} + bytes;
}

inline std::string_view view(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

}  // namespace seaway::fuzz
