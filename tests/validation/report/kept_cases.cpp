#include "tests/validation/report/kept_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/version.hpp"

namespace seaway::validation {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  SEAWAY_CHECK(file, "cannot read {}", path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::optional<CaseRecord> read_record(const fs::path& path) {
  if (!fs::exists(path)) return std::nullopt;
  try {
    const auto json = nlohmann::ordered_json::parse(contents(path), nullptr, false);
    if (json.is_discarded()) fail(ErrorCode::data_loss, "not JSON");
    return record_from(json);
  } catch (const Error& e) {
    std::fprintf(stderr, "%s is left out: %s\n", path.c_str(), e.what());
    return std::nullopt;
  }
}

}  // namespace

std::string digest_of(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;  // fnv: offset basis and prime for 64 bits
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return fmt::format("{:016x}", hash);
}

std::string digest_of_folders(const std::vector<std::string>& folders) {
  std::string all;
  for (const std::string& folder : folders) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      all += fs::relative(file, folder).generic_string() + " " + digest_of(contents(file)) + "\n";
  }
  return digest_of(all);
}

std::string code_identity() {
  return fmt::format("{}+{}", code_version(), digest_of(contents("/proc/self/exe")));
}

KeptCases::KeptCases(std::string folder) : folder_(std::move(folder)) { fs::create_directories(fs::path(folder_) / "cases"); }

std::string KeptCases::file_of(const std::string& name, const std::string& form) const {
  return (fs::path(folder_) / "cases" / (name + "." + form + ".json")).string();
}

std::string KeptCases::runs_folder(const std::string& code) const { return (fs::path(folder_) / "runs" / code).string(); }

std::optional<CaseRecord> KeptCases::finished(const std::string& name, const std::string& form, const std::string& code,
                                              const std::string& digest) const {
  auto record = read_record(file_of(name, form));
  if (!record || record->code != code || record->digest != digest || !record->error.empty()) return std::nullopt;
  return record;
}

void KeptCases::keep(const CaseRecord& record) const {
  const std::string path = file_of(record.name, record.form);
  {
    std::ofstream file(path + ".part");
    file << to_json(record).dump() << "\n";
    SEAWAY_CHECK(file.flush(), "cannot write {}.part", path);
  }
  fs::rename(path + ".part", path);
}

std::vector<CaseRecord> KeptCases::all() const {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(folder_) / "cases"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<CaseRecord> out;
  for (const fs::path& file : files)
    if (auto record = read_record(file)) out.push_back(std::move(*record));
  return out;
}

}  // namespace seaway::validation
