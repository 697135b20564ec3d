// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/maintenance.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "server/store/verify.hpp"

namespace seaway::server {
namespace {

/// Targets are what callers have sent, known to us or not.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f) c = '?';
  return text;
}

}  // namespace

int backup(const std::string& data_dir, const std::string& to) {
  store::backup_database(data_dir + "/seaway.db", to);
  const auto copy = store::verify_database(to);
  for (const std::string& problem : copy.problems) std::printf("%s\n", problem.c_str());
  std::printf("%s: %lld jobs, %lld samples%s\n", to.c_str(), static_cast<long long>(copy.jobs),
              static_cast<long long>(copy.samples), copy.problems.empty() ? "" : "; damaged");
  return copy.problems.empty() ? 0 : 1;
}

int verify(const std::string& data_dir) {
  const auto found = store::verify_database(data_dir + "/seaway.db");
  for (const std::string& problem : found.problems) std::printf("%s\n", problem.c_str());
  std::printf("%lld jobs, %lld samples, %zu problems\n", static_cast<long long>(found.jobs),
              static_cast<long long>(found.samples), found.problems.size());
  return found.problems.empty() ? 0 : 1;
}

int audit(const std::string& data_dir, int rows, bool only_denied) {
  auto found = store::read_audit(data_dir + "/seaway.db", rows, only_denied);
  std::reverse(found.begin(), found.end());
  for (const store::AuditRow& row : found) {
    const std::time_t seconds = row.time_ns / 1'000'000'000;
    std::tm utc{};
    ::gmtime_r(&seconds, &utc);
    char time[32];
    std::strftime(time, sizeof time, "%Y-%m-%dT%H:%M:%SZ", &utc);
    std::printf("%s  %-12s %-24s %-16s %-8s %s\n", time, row.principal.empty() ? "-" : row.principal.c_str(), row.peer.c_str(),
                row.method.c_str(), row.outcome.c_str(), printable(row.target).c_str());
  }
  return 0;
}

}  // namespace seaway::server
