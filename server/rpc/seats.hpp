// SPDX-License-Identifier: GPL-3.0-or-later
// How many streams may be open, in all and for one caller: nobody takes the places of the others. Safe from any thread.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace seaway::rpc {

class Seats {
 public:
  Seats(int in_all, int per_caller) : in_all_(in_all), per_caller_(per_caller) {}
  /// A place, given back when the last copy of it ends; the seats outlive it. Throws Error(resource_exhausted) if there is none.
  std::shared_ptr<const void> take(const std::string& caller);

 private:
  const int in_all_, per_caller_;
  std::mutex mutex_;
  int taken_ = 0;                     // guarded by mutex_
  std::map<std::string, int> holds_;  // guarded by mutex_; by caller, nobody with none
};

}  // namespace seaway::rpc
