// SPDX-License-Identifier: GPL-3.0-or-later
// What the cases of seaway-stress share.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "client/job_client.hpp"
#include "tests/support/process.hpp"

namespace seaway::stress {

struct Settings {
  std::string seawayd, seaway_run, seaway, case_file, disk_full_library;
  int rounds = 100;  ///< of shutdown
  int clients = 500;
  int kills = 10;
  int seeds = 10000;
  int flips = 10000;
  int first_write = 1, writes = 200;  ///< disk_full: the first one that fails, and how many of them
  int write_step = 1;
  int threads = 1;                   ///< of the solver
  double seconds = 120;              ///< longest time to watch a run; it is cancelled then
  double checkpoint_interval_s = 5;
  unsigned seed = 1;
  bool json = false;
  bool no_memory_bars = false;  ///< memory is shown, and no bar: for programs with a sanitizer
};

/// One line of the result; `pass` is value <= reference, or >= with at_least.
struct Line {
  std::string name, quantity;
  double value = 0;
  std::string unit;
  double reference = 0;
  double cpu_s = 0;
  bool at_least = false;
  bool beside = false;  ///< no bar: what the machine gives, to judge the others by
  bool pass() const { return beside ? true : at_least ? value >= reference : value <= reference; }
};
void print(const Line& line, bool json);

std::vector<Line> watch(const Settings& settings);
std::vector<Line> submit(const Settings& settings);
std::vector<Line> list(const Settings& settings);
std::vector<Line> boot(const Settings& settings);
std::vector<Line> shutdown(const Settings& settings);
std::vector<Line> dead_peer(const Settings& settings);
std::vector<Line> overhead(const Settings& settings);
std::vector<Line> soak(const Settings& settings);
std::vector<Line> slow_clients(const Settings& settings);
std::vector<Line> catch_up(const Settings& settings);
std::vector<Line> get_job(const Settings& settings);
std::vector<Line> kill(const Settings& settings);
std::vector<Line> bit_flips(const Settings& settings);
std::vector<Line> simulation(const Settings& settings);
std::vector<Line> disk_full(const Settings& settings);
std::vector<Line> requests(const Settings& settings);

/// CPU that a process has used [s].
double cpu_seconds(pid_t pid);
/// Files that a process has open.
int descriptors(pid_t pid);
/// kill -9 of a worker that runs now on this data folder; false if there is none.
bool kill_worker(const std::string& data);
/// The case file as a request with a new id, with the table that it names.
v1::CreateJobRequest request_of(const std::string& case_file);
/// Options of seawayd for these settings, as a file in `folder`.
std::vector<std::string> daemon_arguments(const Settings& settings, const std::string& folder);
/// A channel that shares its connection with nobody.
std::shared_ptr<grpc::Channel> own_channel(const std::string& address);
/// The history of an unbroken run as CSV without its header, computed in `folder`.
std::string unbroken_csv(const Settings& settings, const std::string& folder);
/// The stored history as CSV without its header.
std::string history_csv_of(client::JobClient& client, const std::string& job);

}  // namespace seaway::stress
