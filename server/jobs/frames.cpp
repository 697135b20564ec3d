// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/frames.hpp"

#include <zlib.h>

#include <cstring>

#include "core/base/error.hpp"

namespace seaway::jobs {
namespace {

struct Head {
  std::uint32_t size, crc;
};

/// Over length and content, so that a wrong length is found as well.
std::uint32_t check_sum(std::uint32_t size, std::string_view content) {
  const auto head = crc32_z(0, reinterpret_cast<const Bytef*>(&size), sizeof size);
  return static_cast<std::uint32_t>(crc32_z(head, reinterpret_cast<const Bytef*>(content.data()), content.size()));
}

}  // namespace

std::string make_frame(std::string_view content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  const Head head{size, check_sum(size, content)};
  std::string out(reinterpret_cast<const char*>(&head), sizeof head);
  out.append(content);
  return out;
}

std::optional<std::string> FrameReader::next() {
  Head head{};
  if (left_over() < sizeof head) return std::nullopt;
  std::memcpy(&head, buffer_.data() + at_, sizeof head);
  if (head.size > max_frame) fail(ErrorCode::data_loss, "a record of the worker claims {} bytes", head.size);
  if (left_over() < sizeof head + head.size) return std::nullopt;
  std::string content = buffer_.substr(at_ + sizeof head, head.size);
  if (head.crc != check_sum(head.size, content)) fail(ErrorCode::data_loss, "a record of the worker is damaged");
  at_ += sizeof head + head.size;
  if (at_ > buffer_.size() / 2) {
    buffer_.erase(0, at_);
    at_ = 0;
  }
  return content;
}

}  // namespace seaway::jobs
