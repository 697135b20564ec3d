#include "tests/validation/support/kept_runs.hpp"

#include <unistd.h>

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/validation/report/kept_cases.hpp"

namespace seaway::validation {
namespace {

namespace fs = std::filesystem;

/// Tells one version of an example from another.
std::string digest_of_example(const std::string& example) {
  std::ifstream file(std::string(SEAWAY_EXAMPLES) + "/" + example);
  std::stringstream text;
  text << file.rdbuf();
  return digest_of(text.str());
}

}  // namespace

KeptRuns::KeptRuns(const std::string& folder, const std::string& name, const std::string& of_project)
    : of_project_(of_project),
      path_(folder.empty() ? (fs::temp_directory_path() / ("seaway_" + name + "_" + std::to_string(::getpid()))).string()
                           : folder),
      keep_(!folder.empty()) {
  fs::create_directories(path_);
}

KeptRuns::~KeptRuns() {
  std::error_code ignored;
  if (!keep_) fs::remove_all(path_, ignored);
}

std::string KeptRuns::file(const std::string& name) const { return (fs::path(path_) / name).string(); }

RunRecord KeptRuns::finished(const std::string& name, const std::string& example, const sim::Case& c, int threads,
                             const std::function<bool(double, int)>& enough) const {
  RunRecord record;
  const std::string digest = name + " " + digest_of_example(example);
  if (load(file(name + ".json"), record) && record.digest == digest) return record;
  // With --results a run is wanted that is the code's own.
  if (!keep_ && load((fs::path(of_project_) / (name + ".json")).string(), record) && record.digest == digest) {
    fmt::print(stderr, "{}: a run kept with the project ({}, version {}, {:.0f} CPU s); --results DIR runs it anew\n", name, of_project_,
               record.version, record.total_cpu_s);
    return record;
  }
  record = run_and_record(c, file(name), threads, enough, digest);
  save(record, file(name + ".json"));
  return record;
}

}  // namespace seaway::validation
