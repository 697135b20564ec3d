// Runs a list of cases one after the other; with a report folder, each case's record is kept there as the case ends, and
// what is finished there is not run again.
#pragma once

#include "tests/validation/cases.hpp"

namespace seaway::validation {

const char* name_of(Suite suite);

/// Exit status: 0 if every line passed, 1 if one failed. `report`: folder; empty: none.
int run_suite(const std::vector<const Case*>& cases, Context context, Format format, const std::string& report);

/// Writes the report of what is kept in the folder, without running anything; status as above.
int report_kept(const std::string& folder);

}  // namespace seaway::validation
