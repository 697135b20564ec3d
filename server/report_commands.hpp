// SPDX-License-Identifier: GPL-3.0-or-later
// `seaway-run decay` and `seaway-run rao`: what the histories of finished runs say.
#pragma once

#include <string>
#include <vector>

#include "seaway/v1/analysis.pb.h"

namespace seaway::server {

struct ReportOptions {
  std::vector<std::string> files;  ///< history.csv or run folders
  std::string folder;              ///< rao: where the picture goes; empty: none
  bool json = false;
  v1::DecayOptions decay;
  v1::RaoOptions rao;
};

/// Both print their reports and return the exit code: 1 if a run has no numbers. Throw Error, convert::InputError,
/// yaml::InputError.
int print_decay(const ReportOptions& options);
int print_rao(const ReportOptions& options);

}  // namespace seaway::server
