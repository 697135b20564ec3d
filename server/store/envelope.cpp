// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/envelope.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "server/store/bytes.hpp"
#include "server/store/chunk.hpp"

namespace seaway::store {
namespace {

struct Head {
  std::uint32_t points, channels;
};

}  // namespace

EnvelopePoint point_of(const Sample& s) { return {s.sequence, s.sequence, s.time, s.values, s.values}; }

void join(EnvelopePoint& point, const EnvelopePoint& more) {
  if (point.minimum.size() != more.minimum.size())
    fail(ErrorCode::data_loss, "samples {} and {} have different channels", point.last, more.first);
  point.last = more.last;
  for (std::size_t c = 0; c < point.minimum.size(); ++c) {
    point.minimum[c] = std::fmin(point.minimum[c], more.minimum[c]);  // a number wins over NaN
    point.maximum[c] = std::fmax(point.maximum[c], more.maximum[c]);
  }
}

std::string encode_points(const std::vector<EnvelopePoint>& points) {
  std::string out;
  put(out, Head{static_cast<std::uint32_t>(points.size()),
                points.empty() ? 0 : static_cast<std::uint32_t>(points.front().minimum.size())});
  for (const EnvelopePoint& p : points) {
    put(out, p.first);
    put(out, p.last);
    put(out, p.time);
    for (const double v : p.minimum) put(out, v);
    for (const double v : p.maximum) put(out, v);
  }
  return out;
}

std::vector<EnvelopePoint> decode_points(std::string_view bytes, std::uint32_t crc) {
  std::size_t at = 0;
  if (bytes.size() < sizeof(Head) || chunk_crc(bytes) != crc) fail(ErrorCode::data_loss, "an envelope is damaged");
  const Head head = get<Head>(bytes, at);
  if (bytes.size() != sizeof head + head.points * (24 + std::size_t{16} * head.channels))
    fail(ErrorCode::data_loss, "an envelope is damaged");
  std::vector<EnvelopePoint> out(head.points);
  for (EnvelopePoint& p : out) {
    p.first = get<std::int64_t>(bytes, at);
    p.last = get<std::int64_t>(bytes, at);
    p.time = get<double>(bytes, at);
    for (auto* values : {&p.minimum, &p.maximum})
      for (std::uint32_t c = 0; c < head.channels; ++c) values->push_back(get<double>(bytes, at));
  }
  return out;
}

}  // namespace seaway::store
