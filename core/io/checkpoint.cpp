#include "core/io/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"

namespace seaway::io {
namespace {

constexpr char magic[8] = {'S', 'E', 'A', 'W', 'A', 'Y', 'C', 'K'};
constexpr std::uint32_t format_version = 1;

std::uint32_t crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void append_text(std::string& out, const std::string& text) {
  append(out, static_cast<std::uint64_t>(text.size()));
  out += text;
}

class Cursor {
 public:
  Cursor(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) {}
  template <class T>
  T take() {
    T value;
    std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view bytes(std::uint64_t count) {
    if (count > bytes_.size() - at_) fail(ErrorCode::data_loss, "checkpoint {} is truncated", path_);
    const std::string_view view(bytes_.data() + at_, count);
    at_ += count;
    return view;
  }
  std::string text() { return std::string(bytes(take<std::uint64_t>())); }

 private:
  const std::string& bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
};

[[noreturn]] void fail_write(const std::string& path) {
  const int error = errno;
  fail(error == ENOSPC ? ErrorCode::resource_exhausted : ErrorCode::unavailable, "cannot write checkpoint {}: {}",
       path, std::strerror(error));
}

struct File {
  int fd = -1;
  ~File() {
    if (fd >= 0) ::close(fd);
  }
};

}  // namespace

void CheckpointWriter::add(const std::string& name, std::span<const double> values) {
  sections_[name].assign(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

void CheckpointWriter::write(const std::string& path, const std::string& case_digest) const {
  std::string bytes(magic, sizeof magic);
  append(bytes, format_version);
  append_text(bytes, case_digest);
  append(bytes, static_cast<std::uint64_t>(sections_.size()));
  for (const auto& [name, content] : sections_) {
    append_text(bytes, name);
    append(bytes, crc(content));
    append_text(bytes, content);
  }
  append(bytes, crc(bytes));
  const std::string aside = path + ".part";
  {
    File file{::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)};
    if (file.fd < 0) fail_write(path);
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(file.fd, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail_write(path);
      done += static_cast<std::size_t>(count);
    }
    if (::fsync(file.fd) != 0) fail_write(path);
  }
  if (std::rename(aside.c_str(), path.c_str()) != 0) fail_write(path);
  File folder{::open(std::filesystem::path(path).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (folder.fd < 0 || ::fsync(folder.fd) != 0) fail_write(path);
}

CheckpointReader::CheckpointReader(const std::string& path, const std::string& case_digest) : path_(path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(ErrorCode::data_loss, "checkpoint {} cannot be read", path);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (bytes.size() < sizeof magic + 8 || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
    fail(ErrorCode::data_loss, "{} is not a checkpoint", path);
  std::uint32_t stored = 0;
  std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
  if (stored != crc(std::string_view(bytes).substr(0, bytes.size() - sizeof stored)))
    fail(ErrorCode::data_loss, "checkpoint {} is damaged", path);
  Cursor cursor(bytes, path);
  cursor.bytes(sizeof magic);
  if (const auto version = cursor.take<std::uint32_t>(); version != format_version)
    fail(ErrorCode::data_loss, "checkpoint {} has format {}; this program reads {}", path, version, format_version);
  if (cursor.text() != case_digest) fail(ErrorCode::data_loss, "checkpoint {} belongs to another case", path);
  const auto count = cursor.take<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string name = cursor.text();
    const auto sum = cursor.take<std::uint32_t>();
    std::string content = cursor.text();
    if (crc(content) != sum) fail(ErrorCode::data_loss, "section {} of checkpoint {} is damaged", name, path);
    sections_[name] = std::move(content);
  }
}

const std::string& CheckpointReader::text(const std::string& name) const {
  const auto found = sections_.find(name);
  if (found == sections_.end()) fail(ErrorCode::data_loss, "checkpoint {} has no section {}", path_, name);
  return found->second;
}

std::vector<double> CheckpointReader::values(const std::string& name) const {
  const std::string& bytes = text(name);
  if (bytes.size() % sizeof(double) != 0)
    fail(ErrorCode::data_loss, "section {} of checkpoint {} holds no whole numbers", name, path_);
  std::vector<double> out(bytes.size() / sizeof(double));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

}  // namespace seaway::io
