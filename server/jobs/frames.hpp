// SPDX-License-Identifier: GPL-3.0-or-later
// Records in a stream of bytes: length, CRC-32, content. What a process has written when it dies is read up to
// the last whole record; a damaged one is never taken for data. One thread at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seaway::jobs {

/// Largest content of a record; a length beyond it is damage.
inline constexpr std::size_t max_frame = 8 << 20;

/// Header and content. Before: content.size() <= max_frame.
std::string make_frame(std::string_view content);

class FrameReader {
 public:
  void feed(std::string_view bytes) { buffer_.append(bytes); }
  /// The next whole record. Throws Error(data_loss) at a damaged one; the reader is of no use then.
  std::optional<std::string> next();
  /// Bytes of a record that is not complete.
  std::size_t left_over() const { return buffer_.size() - at_; }

 private:
  std::string buffer_;
  std::size_t at_ = 0;
};

}  // namespace seaway::jobs
