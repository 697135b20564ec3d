// SPDX-License-Identifier: GPL-3.0-or-later
// A run as reports want it: its case and its history, out of the store or out of files.
#pragma once

#include <string>
#include <vector>

#include "seaway/v1/case.pb.h"

namespace seaway::reports {

/// Column by column, in units of the edge (degrees).
struct History {
  struct Channel {
    std::string name, unit;
    std::vector<double> values;
  };
  std::vector<int> stages;    ///< from 0
  std::vector<double> times;  ///< [s]
  std::vector<Channel> channels;

  /// Null if there is none of this name.
  const Channel* find(const std::string& name) const;
};

struct Run {
  std::string source;      ///< jobs/<uid>, a folder or a file
  std::string title;
  std::string case_name;   ///< in a sweep; empty: the title
  v1::Case message;        ///< empty if only the history is known
  bool has_case = false;
  History history;
};

/// history.csv as seaway-run and `seaway history` write it. Throws Error(not_found; invalid_argument with file and
/// line).
History read_history(const std::string& file);

/// `path`: a run folder (history.csv, and case.yaml if it is there) or a file history.csv, beside which case.yaml is
/// looked for. Throws as read_history, and yaml::InputError.
Run read_run(const std::string& path);

}  // namespace seaway::reports
