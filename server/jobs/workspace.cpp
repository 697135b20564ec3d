// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/workspace.hpp"

#include <fcntl.h>
#include <openssl/sha.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/error.hpp"

namespace seaway::jobs {
namespace {

namespace fs = std::filesystem;

void sync_folder(const std::string& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(ErrorCode::unavailable, "{}: {}", folder.string(), error.message());
}

bool is_known(const fs::path& file, const std::vector<store::Checkpoint>& checkpoints,
              const std::vector<store::Artifact>& artifacts) {
  for (const store::Artifact& a : artifacts)
    if (file == a.path) return true;
  for (const store::Checkpoint& c : checkpoints) {
    if (file != c.path) continue;
    struct stat info {};
    if (::lstat(c.path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return false;
    return info.st_size == c.size && info.st_ino == c.inode &&
           info.st_mtim.tv_sec * 1'000'000'000 + info.st_mtim.tv_nsec == c.mtime_ns;
  }
  return false;
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::string out;
  for (const unsigned char byte : digest) out += fmt::format("{:02x}", byte);
  return out;
}

Workspace::Workspace(std::string data_dir) : data_dir_(fs::absolute(std::move(data_dir)).lexically_normal().string()) {
  make_folder(fs::path(data_dir_) / "files");
  make_folder(fs::path(data_dir_) / "jobs");
  make_folder(fs::path(data_dir_) / "leases");
}

std::string Workspace::keep_file(std::string_view content) const {
  const std::string folder = data_dir_ + "/files";
  const std::string path = folder + "/" + sha256_hex(content);
  // In use again: the sweeper looks at this time.
  if (::utimensat(AT_FDCWD, path.c_str(), nullptr, AT_SYMLINK_NOFOLLOW) == 0) return path;
  std::string aside = path + ".XXXXXX";
  const int fd = ::mkostemp(aside.data(), O_CLOEXEC);
  if (fd < 0) fail(ErrorCode::unavailable, "{}: {}", aside, std::strerror(errno));
  std::size_t at = 0;
  bool ok = true;
  while (ok && at < content.size()) {
    const ssize_t n = ::write(fd, content.data() + at, content.size() - at);
    if (n > 0)
      at += static_cast<std::size_t>(n);
    else
      ok = n < 0 && errno == EINTR;
  }
  ok = ok && ::fsync(fd) == 0;
  ::close(fd);
  ok = ok && ::rename(aside.c_str(), path.c_str()) == 0;
  if (!ok) {
    const int why = errno;
    ::unlink(aside.c_str());
    fail(ErrorCode::unavailable, "{}: {}", path, std::strerror(why));
  }
  sync_folder(folder);
  return path;
}

int Workspace::sweep_files(std::chrono::seconds unused_for, const std::set<std::string>& used) const {
  const auto is_old = [&](const fs::path& file) {
    std::error_code error;
    const auto touched = fs::last_write_time(file, error);
    return !error && fs::file_time_type::clock::now() - touched > unused_for;
  };
  int removed = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(data_dir_) / "files")) {
    const fs::path file = entry.path(), aside = file.string() + ".unused";
    if (used.count(file.filename().string()) > 0 || !is_old(file)) continue;
    // Who wanted it until now has touched it; who wants it from now on does not find it and writes it anew.
    std::error_code error;
    fs::rename(file, aside, error);
    if (error) continue;
    if (!is_old(aside)) {
      fs::rename(aside, file, error);
    } else if (fs::remove(aside, error)) {
      ++removed;
    }
  }
  return removed;
}

std::string Workspace::lease_path(const std::string& uid) const { return data_dir_ + "/leases/" + uid; }

std::vector<std::string> Workspace::leases() const {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(fs::path(data_dir_) / "leases")) out.push_back(entry.path());
  return out;
}

bool Workspace::has_space() const {
  std::string path = data_dir_ + "/probe.XXXXXX";
  const int fd = ::mkostemp(path.data(), O_CLOEXEC);
  if (fd < 0) return false;
  const std::string bytes(1 << 20, '\0');  // more than a small write finds in a corner
  const bool ok = ::write(fd, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()) && ::fsync(fd) == 0;
  ::close(fd);
  ::unlink(path.c_str());
  return ok;
}

std::int64_t Workspace::run_bytes(const std::string& uid) const {
  std::int64_t sum = 0;
  std::error_code error;
  // Files come and go while this looks: what is gone counts nothing.
  for (fs::recursive_directory_iterator it(run_folder(uid), error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const auto size = it->is_regular_file(gone) ? it->file_size(gone) : 0;
    if (!gone) sum += static_cast<std::int64_t>(size);
  }
  return sum;
}

std::string Workspace::run_folder(const std::string& uid) const { return data_dir_ + "/jobs/" + uid; }

std::vector<std::string> Workspace::prepare_run(const std::string& uid, const std::vector<store::Checkpoint>& checkpoints,
                                                const std::vector<store::Artifact>& artifacts) const {
  const fs::path folder = run_folder(uid);
  make_folder(folder);
  std::vector<fs::path> unknown;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory() && !is_known(entry.path(), checkpoints, artifacts)) unknown.push_back(entry.path());
  std::vector<std::string> removed;
  for (const fs::path& file : unknown) {
    std::error_code error;
    fs::remove(file, error);
    if (error) fail(ErrorCode::unavailable, "{}: {}", file.string(), error.message());
    removed.push_back(file.lexically_relative(folder).string());
  }
  return removed;
}

std::optional<store::Checkpoint> Workspace::newest_checkpoint(const std::vector<store::Checkpoint>& checkpoints) const {
  std::optional<store::Checkpoint> best;
  for (const store::Checkpoint& c : checkpoints)
    if (is_known(c.path, {c}, {}) && (!best || c.sequence >= best->sequence)) best = c;
  return best;
}

store::Checkpoint Workspace::copy_checkpoint(const store::Checkpoint& checkpoint, const std::string& to_uid) const {
  const fs::path folder = run_folder(to_uid);
  make_folder(folder);
  const fs::path target = folder / fs::path(checkpoint.path).filename();
  std::error_code error;
  fs::copy_file(checkpoint.path, target, fs::copy_options::overwrite_existing, error);
  if (error) fail(ErrorCode::unavailable, "{}: {}", target.string(), error.message());
  const int fd = ::open(target.c_str(), O_RDONLY | O_CLOEXEC);
  const bool ok = fd >= 0 && ::fsync(fd) == 0;
  if (fd >= 0) ::close(fd);
  if (!ok) fail(ErrorCode::unavailable, "{}: {}", target.string(), std::strerror(errno));
  sync_folder(folder);
  return describe_checkpoint(target.string(), checkpoint.sequence);
}

void Workspace::remove_run(const std::string& uid) const {
  std::error_code error;
  fs::remove_all(run_folder(uid), error);
}

store::Checkpoint describe_checkpoint(const std::string& path, std::int64_t sequence) {
  struct stat info {};
  const std::string absolute = fs::absolute(path).lexically_normal().string();
  if (::lstat(absolute.c_str(), &info) != 0) fail(ErrorCode::not_found, "checkpoint {}: {}", path, std::strerror(errno));
  return {sequence, absolute, info.st_size, info.st_mtim.tv_sec * 1'000'000'000 + info.st_mtim.tv_nsec, info.st_ino};
}

}  // namespace seaway::jobs
