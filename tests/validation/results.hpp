// What a validation case reports: one line a quantity, printed at once, in a table or as
//   {"case","quantity","value","unit","reference","tolerance","pass","cpu_s"}
#pragma once

#include <cstdio>
#include <string>

#include "tests/validation/report/case_record.hpp"

namespace seaway::validation {

enum class Format { table, json };

/// Writes lines and remembers whether one failed. A value that is not a number fails whatever it is
/// compared with.
class Results {
 public:
  Results(std::string case_name, Format format, std::FILE* out = stdout);

  /// value <= limit
  void expect_below(const std::string& quantity, double value, const std::string& unit,
                    double limit);
  /// value >= limit
  void expect_above(const std::string& quantity, double value, const std::string& unit,
                    double limit);
  /// |value - reference| <= tolerance, in the value's unit
  void expect_near(const std::string& quantity, double value, const std::string& unit,
                   double reference, double tolerance);
  /// A number that has no bar: always passes unless it is not a number.
  void report(const std::string& quantity, double value, const std::string& unit);
  /// Curves for the report, computed beside reference.
  void plot(Plot plot) { record_.plots.push_back(std::move(plot)); }
  /// A quantity on several meshes, for the report's grid convergence.
  void refinement(Refinement refinement) { record_.refinements.push_back(std::move(refinement)); }
  /// The case could not be finished: a failed line "error", and the reason on stderr.
  void fail(const std::string& reason);

  /// Lines, curves and meshes of a case that was run before.
  void replay(const CaseRecord& record);

  int lines() const { return static_cast<int>(record_.lines.size()); }
  int failures() const { return record_.failures(); }
  /// All so far; name, lines, curves, meshes, error and CPU time are set.
  const CaseRecord& record() const { return record_; }

  static void print_table_header(std::FILE* out);

 private:
  void add(Line line);
  void print(const Line& line) const;

  const Format format_;
  std::FILE* const out_;
  double cpu_before_;
  CaseRecord record_;
};

}  // namespace seaway::validation
