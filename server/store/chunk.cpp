// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/chunk.hpp"

#include <zlib.h>

#include <bit>
#include <cstring>

#include "core/base/error.hpp"
#include "server/store/bytes.hpp"

namespace seaway::store {
namespace {

static_assert(std::endian::native == std::endian::little, "chunks are stored little-endian");
constexpr std::uint32_t magic = 0x31435753;  // "SWC1"

struct Head {
  std::uint32_t magic, n, columns, reserved;
  std::int64_t first;
};

}  // namespace

std::uint32_t chunk_crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::string encode_chunk(const std::vector<Sample>& samples) {
  const std::size_t n = samples.size();
  const std::size_t columns = n == 0 ? 0 : samples.front().values.size();
  std::string out;
  out.reserve(sizeof(Head) + n * (20 + 8 * columns));
  put(out, Head{magic, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(columns), 0,
                n == 0 ? 0 : samples.front().sequence});
  for (const Sample& s : samples) {
    if (s.values.size() != columns)
      fail(ErrorCode::internal, "sample {} has {} values, the ones before have {}", s.sequence, s.values.size(), columns);
    put(out, s.stage);
  }
  for (const Sample& s : samples) put(out, s.step);
  for (const Sample& s : samples) put(out, s.time);
  for (std::size_t c = 0; c < columns; ++c)
    for (const Sample& s : samples) put(out, s.values[c]);
  return out;
}

std::vector<Sample> decode_chunk(std::string_view bytes, std::uint32_t crc) {
  Head head{};
  if (bytes.size() < sizeof head) fail(ErrorCode::data_loss, "a chunk of samples is cut off");
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::size_t n = head.n;
  const std::size_t columns = head.columns;
  if (head.magic != magic || n > chunk_samples || columns > 100000 ||
      bytes.size() != sizeof head + n * (20 + 8 * columns) || chunk_crc(bytes) != crc)
    fail(ErrorCode::data_loss, "a chunk of samples is damaged (first sequence {})", head.first);
  std::vector<Sample> samples(n);
  std::size_t at = sizeof head;
  for (std::size_t i = 0; i < n; ++i) {
    samples[i].sequence = head.first + static_cast<std::int64_t>(i);
    samples[i].stage = get<std::int32_t>(bytes, at);
    samples[i].values.resize(columns);
  }
  for (Sample& s : samples) s.step = get<std::int64_t>(bytes, at);
  for (Sample& s : samples) s.time = get<double>(bytes, at);
  for (std::size_t c = 0; c < columns; ++c)
    for (Sample& s : samples) s.values[c] = get<double>(bytes, at);
  return samples;
}

}  // namespace seaway::store
