// Long runs of examples, kept in a folder: what is finished is read, what was cut goes on.
#pragma once

#include <functional>
#include <string>

#include "tests/validation/support/run_record.hpp"

namespace seaway::validation {

class KeptRuns {
 public:
  /// `folder`: as given with --results; empty: one named after `name` that goes away with this object.
  KeptRuns(const std::string& folder, const std::string& name);
  ~KeptRuns();
  KeptRuns(const KeptRuns&) = delete;
  KeptRuns& operator=(const KeptRuns&) = delete;

  std::string file(const std::string& name) const;

  /// The record of run `name` of an example (a file name of client/examples, or a variant of it in `c`): read if it
  /// is there, else run until it ends or `enough(time, stage)` says so. Another text of the example is another run.
  RunRecord finished(const std::string& name, const std::string& example, const sim::Case& c, int threads,
                     const std::function<bool(double, int)>& enough) const;

 private:
  std::string path_;
  bool keep_;
};

}  // namespace seaway::validation
