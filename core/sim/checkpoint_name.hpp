// SPDX-License-Identifier: GPL-3.0-or-later
// What the name of a checkpoint says: `...<sequence>e<stage>.<extension>` holds the end of a stage, any other a moment inside
// one. Ends of stages are kept while the run's folder is, so that a run can be repeated from the stage that follows.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace seaway::sim {

/// The stage (from 0) whose end is in the file; none for other checkpoints. `path` may have folders.
inline std::optional<int> stage_ended_in(std::string_view path) {
  std::string_view name = path.substr(path.rfind('/') + 1);
  name = name.substr(0, name.rfind('.'));
  const auto e = name.rfind('e');
  if (e == name.npos || e == 0 || name[e - 1] < '0' || name[e - 1] > '9') return std::nullopt;
  int stage = 0;
  const auto read = std::from_chars(name.data() + e + 1, name.data() + name.size(), stage);
  if (read.ec != std::errc{} || read.ptr != name.data() + name.size() || stage < 0) return std::nullopt;
  return stage;
}

}  // namespace seaway::sim
