// One report of many cases: report.json for programs, report.html for people (one file, no scripts, no links outside).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/validation/report/case_record.hpp"

namespace seaway::validation {

struct ReportInput {
  std::vector<CaseRecord> cases;
  std::vector<std::string> missing;  ///< asked for and not finished
  std::string code;                  ///< of the program that writes; records of other code are marked
};

/// {"code", "summary": {"cases", "quantities", "failed", "missing"}, "cases": [record and "refinements" with
/// "order", "extrapolated", "expanded_uncertainty", "comparison_error", "u_val", ...]}
nlohmann::ordered_json report_json(const ReportInput& input);
std::string report_html(const ReportInput& input);

/// Writes both into the folder, aside and renamed. Throws Error(unavailable).
void write_report(const ReportInput& input, const std::string& folder);

}  // namespace seaway::validation
