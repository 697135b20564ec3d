// Records of finished cases in a folder: what makes a long suite resumable.
//
//   DIR/cases/NAME.FORM.json   one a case and form (quick, full, ships), written aside and renamed
//   DIR/runs/CODE              what long cases keep of their runs (Context::results)
//
// A record counts as finished for a later run only if the code is the same (version and digest of the program) and so
// is what the case reads (digest of its folder and of the examples), and if it ended without an error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/validation/report/case_record.hpp"

namespace seaway::validation {

/// 64-bit FNV-1a [fnv], hexadecimal. Tells versions apart; no protection against ill will.
std::string digest_of(const std::string& bytes);
/// Of names and contents of all files under the folders, in alphabetical order.
std::string digest_of_folders(const std::vector<std::string>& folders);
/// Version and digest of this program.
std::string code_identity();

class KeptCases {
 public:
  explicit KeptCases(std::string folder);
  /// The record of the case if it is finished for this code and digest.
  std::optional<CaseRecord> finished(const std::string& name, const std::string& form, const std::string& code,
                                     const std::string& digest) const;
  void keep(const CaseRecord& record) const;
  /// All that is there, whatever made it, by name. A file that is no record is named on stderr and left out.
  std::vector<CaseRecord> all() const;
  std::string runs_folder(const std::string& code) const;
  const std::string& folder() const { return folder_; }

 private:
  std::string file_of(const std::string& name, const std::string& form) const;
  std::string folder_;
};

}  // namespace seaway::validation
