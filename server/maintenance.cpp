// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/maintenance.hpp"

#include <cstdio>

#include "server/store/verify.hpp"

namespace seaway::server {

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

}  // namespace seaway::server
