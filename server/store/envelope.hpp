// SPDX-License-Identifier: GPL-3.0-or-later
// A history as few points: smallest and largest value of each channel in runs of samples. Runs of 16, 256, 4096 ...
// samples are stored with the history, so that any part of any length is read in about the same time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/job.hpp"

namespace seaway::store {

struct EnvelopePoint {
  std::int64_t first = 0, last = 0;  ///< sequence numbers
  double time = 0;                   ///< of the first sample
  std::vector<double> minimum, maximum;  ///< one per channel; NaN if there was no number
};

/// Joins `more`, which follows.
void join(EnvelopePoint& point, const EnvelopePoint& more);
EnvelopePoint point_of(const Sample& sample);

/// Levels 1 .. envelope_levels hold runs of 16^level samples.
inline constexpr int envelope_levels = 5;
constexpr std::int64_t envelope_run(int level) { return std::int64_t{1} << (4 * level); }

std::string encode_points(const std::vector<EnvelopePoint>& points);
/// Throws Error(data_loss) if the bytes are not what was encoded.
std::vector<EnvelopePoint> decode_points(std::string_view bytes, std::uint32_t crc);

}  // namespace seaway::store
