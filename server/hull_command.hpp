// SPDX-License-Identifier: GPL-3.0-or-later
// `seaway-run hull`: particulars, hydrostatics and stability of a ship, body plan and GZ curve.
#pragma once

#include <string>

#include "core/sim/case.hpp"

namespace seaway::server {

struct HullOptions {
  std::string folder;        ///< pictures and their data; empty: none
  bool json = false;
  // For a hull's file instead of a case:
  double scale = 1;          ///< offsets: lengths are divided by it
  double unit = 0;           ///< STL: metres in its unit
  double amidships = 0;      ///< in the file's unit
  double draft = 0;          ///< [m]; 0: only the table over drafts
  double kg = 0;             ///< [m]; 0: no stability
};

/// The case that a bare file stands for: .csv a table of half-breadths, .stl a surface. Throws
/// Error(invalid_argument) for another ending.
sim::Case case_of_hull_file(const std::string& file, const HullOptions& options);

/// Prints the report of a ship's case. Throws Error (wrong hull; failed_precondition: no gnuplot). Returns the
/// exit code.
int print_hull(const sim::Case& c, const HullOptions& options);

}  // namespace seaway::server
