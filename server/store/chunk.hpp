// SPDX-License-Identifier: GPL-3.0-or-later
// A run of consecutive samples as one blob: little-endian, column by column.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/job.hpp"

namespace seaway::store {

/// Samples of a sealed chunk.
inline constexpr int chunk_samples = 512;

/// All samples must have the same number of values and consecutive sequence numbers.
std::string encode_chunk(const std::vector<Sample>& samples);
/// Throws Error(data_loss) if the bytes are not what was encoded.
std::vector<Sample> decode_chunk(std::string_view bytes, std::uint32_t crc);
std::uint32_t chunk_crc(std::string_view bytes);

}  // namespace seaway::store
