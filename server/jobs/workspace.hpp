// SPDX-License-Identifier: GPL-3.0-or-later
// The files of the service under its data folder:
//   files/<sha256>       what clients sent with their cases, under the digest of the content
//   jobs/<uid>/          working folder of a run: checkpoints and artifacts
//   leases/<uid>         locked by the process that runs the job, while it lives
// Names that users chose never become file names. Safe from any thread.
#pragma once

#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/job.hpp"

namespace seaway::jobs {

/// Lower-case hexadecimal SHA-256.
std::string sha256_hex(std::string_view bytes);

class Workspace {
 public:
  /// Makes the folders if they are missing.
  explicit Workspace(std::string data_dir);

  /// Stores the content durably (written aside, synced, renamed) and returns its path.
  std::string keep_file(std::string_view content) const;
  /// Removes kept files that nobody has asked for since `unused_for`, except those whose digests are `used`; how many.
  /// Each comes again when its case runs, as the store has the content too.
  int sweep_files(std::chrono::seconds unused_for, const std::set<std::string>& used) const;

  const std::string& data_dir() const { return data_dir_; }
  std::string lease_path(const std::string& uid) const;
  /// All that are there.
  std::vector<std::string> leases() const;
  /// Whether the data folder takes new data: tries it.
  bool has_space() const;
  /// Size of all files of a run.
  std::int64_t run_bytes(const std::string& uid) const;
  std::string run_folder(const std::string& uid) const;
  /// Makes the run folder and removes from it everything that the store does not know: a checkpoint whose
  /// record was lost may be newer than the stored history, and going on from it would leave a gap.
  /// Returns the names of what was removed.
  std::vector<std::string> prepare_run(const std::string& uid, const std::vector<store::Checkpoint>& checkpoints,
                                       const std::vector<store::Artifact>& artifacts) const;
  /// The newest one whose file is still the one that was recorded.
  std::optional<store::Checkpoint> newest_checkpoint(const std::vector<store::Checkpoint>& checkpoints) const;
  /// Copies it, durably, into the folder of another run.
  store::Checkpoint copy_checkpoint(const store::Checkpoint& checkpoint, const std::string& to_uid) const;
  void remove_run(const std::string& uid) const;

 private:
  std::string data_dir_;
};

/// `path` with what tells later whether the file is still the same. Throws not_found.
store::Checkpoint describe_checkpoint(const std::string& path, std::int64_t sequence);

}  // namespace seaway::jobs
