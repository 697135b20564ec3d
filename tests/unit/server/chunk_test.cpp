// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/chunk.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.hpp"

namespace seaway::store {
namespace {

std::vector<Sample> some(int n) {
  std::vector<Sample> out;
  for (int i = 0; i < n; ++i) out.push_back({100 + i, i / 3, 7 * i, 0.1 * i, {1.0 / (i + 1), -0.0, std::numeric_limits<double>::quiet_NaN()}});
  return out;
}

TEST(Chunk, GivesBackTheSameBits) {
  for (const int n : {1, 2, 511, 512}) {
    const auto samples = some(n);
    const std::string bytes = encode_chunk(samples);
    const auto back = decode_chunk(bytes, chunk_crc(bytes));
    ASSERT_EQ(back.size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_TRUE(same_bits(samples[i], back[i]));
  }
}

TEST(Chunk, RefusesEveryDamage) {
  const std::string bytes = encode_chunk(some(5));
  const auto crc = chunk_crc(bytes);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_THROW(decode_chunk(damaged, crc), Error) << at;
    EXPECT_THROW(decode_chunk(std::string_view(bytes).substr(0, at), crc), Error) << at;
  }
}

TEST(Chunk, RefusesSamplesOfDifferentWidth) {
  auto samples = some(2);
  samples[1].values.pop_back();
  EXPECT_THROW(encode_chunk(samples), Error);
}

}  // namespace
}  // namespace seaway::store
