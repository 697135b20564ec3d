// What a case leaves behind: its lines, curves beside their references, quantities on several meshes. Kept as one JSON
// file a case; the report is written from these alone.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace seaway::validation {

struct Line {
  std::string case_name, quantity;
  double value = 0;
  std::string unit;                 ///< SI; "1" for plain numbers
  std::optional<double> reference;  ///< the value wanted; least allowed value for expect_above
  std::optional<double> tolerance;  ///< largest distance to it; largest value for expect_below
  bool pass = true;
  double cpu_s = 0;  ///< CPU seconds (all threads) since the case's line before
};

struct Curve {
  std::string label;
  std::vector<double> x, y;
  bool reference = false;  ///< measured or exact: drawn as points
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  bool log_axes = false;
};

/// A quantity on meshes of cells `h`, whose finest value is compared with `reference`.
struct Refinement {
  std::string quantity, unit;
  std::vector<double> h, value;          ///< h [m], or as parts of a length that the README names
  double formal_order = 2;
  std::optional<double> reference;       ///< measured, or exact
  double u_data = 0, u_input = 0;        ///< standard uncertainties of the measurement, of what was put in
};

struct CaseRecord {
  std::string name, what, form;          ///< form: quick | full | ships
  std::string code, digest;              ///< that made it; see kept_cases.hpp
  std::string ended;                     ///< UTC, ISO 8601
  std::string error;                     ///< why the case could not be finished
  double cpu_s = 0;
  std::vector<Line> lines;
  std::vector<Plot> plots;
  std::vector<Refinement> refinements;
  int failures() const;
};

/// null for what is not finite.
nlohmann::ordered_json json_number(std::optional<double> x);
nlohmann::ordered_json to_json(const CaseRecord& record);
/// Throws Error(data_loss) if the text is not one.
CaseRecord record_from(const nlohmann::ordered_json& json);

}  // namespace seaway::validation
