// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/download.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/error.hpp"
#include "server/rpc/messages.hpp"

namespace seaway::rpc {
namespace {

constexpr std::int64_t piece = 64 * 1024;

}  // namespace

DownloadCall::~DownloadCall() {
  if (fd_ >= 0) ::close(fd_);
}

void DownloadCall::open() {
  const std::string uid = parse_job_name(request_.job(), "job");
  if (request_.artifact().empty()) refuse_field("artifact", "is missing", "ListArtifacts shows their names");
  if (request_.offset() < 0) refuse_field("offset", "is negative", "0 starts at the first byte");
  std::string path;
  for (const store::Artifact& a : store_.artifacts(uid))
    if (a.name == request_.artifact()) path = a.path;
  if (path.empty()) fail(ErrorCode::not_found, "job {} has no artifact '{}'; ListArtifacts shows those it has", uid, request_.artifact());
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  struct stat info {};
  if (fd_ < 0 || ::fstat(fd_, &info) != 0)
    fail(ErrorCode::data_loss, "artifact '{}' of job {}: {}", request_.artifact(), uid, std::strerror(errno));
  size_ = info.st_size;
  at_ = request_.offset();
  if (at_ > size_)
    throw OutOfRange("offset " + std::to_string(at_) + "; the artifact has " + std::to_string(size_) + " bytes");
}

StreamCall<v1::DownloadArtifactResponse>::Next DownloadCall::next(v1::DownloadArtifactResponse& response, bool) {
  if (fd_ < 0) open();
  if (!first_ && at_ >= size_) return Next::end;
  if (first_) response.set_size_bytes(size_);
  first_ = false;
  std::string& data = *response.mutable_data();
  data.resize(static_cast<std::size_t>(std::min(piece, size_ - at_)));
  std::size_t got = 0;
  while (got < data.size()) {
    const ssize_t n = ::pread(fd_, data.data() + got, data.size() - got, at_ + static_cast<std::int64_t>(got));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(ErrorCode::data_loss, "artifact '{}' became shorter while it was read", request_.artifact());
    got += static_cast<std::size_t>(n);
  }
  at_ += static_cast<std::int64_t>(got);
  return Next::message;
}

}  // namespace seaway::rpc
