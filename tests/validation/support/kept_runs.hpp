// Long runs of examples, kept in a folder: what is finished is read, what was cut goes on. The longest are kept with the
// project too (tests/validation/kept_runs), with the digest of their example and the version of the code that made them.
#pragma once

#include <functional>
#include <string>

#include "tests/validation/support/run_record.hpp"

namespace seaway::validation {

class KeptRuns {
 public:
  /// `folder`: as given with --results; empty: one named after `name` that goes away with this object.
  /// `of_project`: folder of the runs kept with the project.
  KeptRuns(const std::string& folder, const std::string& name, const std::string& of_project = SEAWAY_VALIDATION "/kept_runs");
  ~KeptRuns();
  KeptRuns(const KeptRuns&) = delete;
  KeptRuns& operator=(const KeptRuns&) = delete;

  std::string file(const std::string& name) const;

  /// The record of run `name` of an example (a file name of client/examples, or a variant of it in `c`): read if it
  /// is there (without --results: or with the project), else run until it ends or `enough(time, stage)` says so. Another
  /// text of the example is another run.
  RunRecord finished(const std::string& name, const std::string& example, const sim::Case& c, int threads,
                     const std::function<bool(double, int)>& enough) const;

 private:
  std::string of_project_, path_;
  bool keep_;
};

}  // namespace seaway::validation
