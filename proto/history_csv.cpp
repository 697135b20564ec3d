// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/history_csv.hpp"

#include <array>
#include <charconv>

namespace seaway::history_csv {
namespace {

template <class Number>
void add(Number value, std::string& out) {
  std::array<char, 32> buffer{};
  out.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

}  // namespace

std::string header(const google::protobuf::RepeatedPtrField<v1::ChannelSchema>& channels) {
  std::string out = "sequence,stage,step,time [s]";
  for (const v1::ChannelSchema& channel : channels) out += "," + channel.name() + " [" + channel.unit() + "]";
  return out + "\n";
}

void append(const v1::SampleChunk& chunk, std::string& out) {
  for (int i = 0; i < chunk.times_s_size(); ++i) {
    add(chunk.first_sequence() + i, out);
    out += ',';
    add(chunk.stages(i), out);
    out += ',';
    add(chunk.steps(i), out);
    out += ',';
    add(chunk.times_s(i), out);
    for (const auto& column : chunk.columns()) {
      out += ',';
      add(column.values(i), out);
    }
    out += '\n';
  }
}

}  // namespace seaway::history_csv
