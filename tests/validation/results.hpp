// What a validation case reports: one line a quantity, printed at once as a table row or as a JSON object
//   {"case","quantity","value","unit","reference","tolerance","pass","cpu_s"}
#pragma once

#include <cstdio>
#include <optional>
#include <string>

namespace seaway::validation {

struct Line {
  std::string case_name, quantity;
  double value = 0;
  std::string unit;                 ///< SI; "1" for plain numbers
  std::optional<double> reference;  ///< the value wanted; least allowed value for expect_above
  std::optional<double> tolerance;  ///< largest allowed distance to it; largest value for expect_below
  bool pass = true;
  double cpu_s = 0;                 ///< CPU seconds (all threads) since the case's line before
};

enum class Format { table, json };

/// Writes lines and remembers whether one failed. A value that is not a number fails whatever it is
/// compared with.
class Results {
 public:
  Results(std::string case_name, Format format, std::FILE* out = stdout);

  /// value <= limit
  void expect_below(const std::string& quantity, double value, const std::string& unit, double limit);
  /// value >= limit
  void expect_above(const std::string& quantity, double value, const std::string& unit, double limit);
  /// |value - reference| <= tolerance, in the value's unit
  void expect_near(const std::string& quantity, double value, const std::string& unit, double reference,
                   double tolerance);
  /// A number that has no bar: always passes unless it is not a number.
  void report(const std::string& quantity, double value, const std::string& unit);
  /// The case could not be finished: a failed line "error", and the reason on stderr.
  void fail(const std::string& reason);

  int lines() const { return lines_; }
  int failures() const { return failures_; }

  static void print_table_header(std::FILE* out);

 private:
  void add(Line line);

  const std::string case_name_;
  const Format format_;
  std::FILE* const out_;
  int lines_ = 0, failures_ = 0;
  double cpu_before_;
};

}  // namespace seaway::validation
