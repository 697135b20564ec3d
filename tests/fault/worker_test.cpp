// SPDX-License-Identifier: GPL-3.0-or-later
// What a solver may do to the service when it runs in a process of its own (F3, F4 of the fault tests): nothing
// but end its own job, after retries from the last checkpoint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "client/job_client.hpp"
#include "proto/history_csv.hpp"
#include "proto/yaml.hpp"
#include "seaway/worker/attempt.pb.h"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using ::testing::HasSubstr;
using client::JobClient;
namespace fs = std::filesystem;

const std::string small = SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml";

class WorkerProcess : public ::testing::Test {
 protected:
  void start(const std::string& workers, int step_us = 300) {
    std::ofstream(folder_ / "config.yaml") << "workers:\n  executor: process\n  program: " << program_ << "\n" << workers;
    daemon_ = std::make_unique<Daemon>(SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", folder_.path(),
                                       std::vector<std::string>{"SEAWAY_FAKE_STEP_US=" + std::to_string(step_us),
                                                                "SEAWAY_FAKE_CHECKPOINT_STEPS=40"},
                                       std::vector<std::string>{"--config", folder_ / "config.yaml"});
    daemon_->start();
    client_ = std::make_unique<JobClient>(daemon_->address());
  }
  std::string submit(const std::string& title) {
    v1::CreateJobRequest request;
    yaml::read_file(small, *request.mutable_case_());
    request.mutable_case_()->set_title(title);
    request.set_request_id(client::new_request_id());
    return client_->create(request).job().name();
  }
  /// Until the job has ended, however often the stream breaks.
  v1::Job ended(const std::string& name) {
    std::int64_t last = 0;
    for (bool end = false; !end;)
      client_->watch(name, last, [&](const v1::WatchSamplesResponse& m) {
        if (m.has_chunk()) last = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
        end = m.has_mark() && m.mark().state() >= v1::Job::STATE_SUCCEEDED;
        return !end;
      });
    return client_->get(name, v1::JOB_VIEW_FULL);
  }
  v1::Job run(const std::string& title) { return ended(submit(title)); }
  void wait_for_samples(const std::string& name, std::int64_t n) {
    client_->watch(name, 0, [&](const v1::WatchSamplesResponse& m) {
      return !(m.has_chunk() && m.chunk().first_sequence() + m.chunk().times_s_size() - 1 >= n);
    });
  }
  std::string csv(const std::string& name) {
    std::string out;
    client_->history(name, [&](const v1::ReadSamplesResponse& page) { history_csv::append(page.chunk(), out); });
    return out;
  }
  /// Without its header.
  std::string unbroken() {
    EXPECT_EQ(run_program({SEAWAY_BUILD_DIR "/tests/seaway_fake_offline", small, "-o", folder_ / "whole", "-q"}).code, 0);
    const std::string text = read_text(folder_ / "whole/history.csv");
    return text.substr(text.find('\n') + 1);
  }
  std::string lease_of(const std::string& name) { return folder_ / ("data/leases/" + name.substr(5)); }
  pid_t worker_of(const std::string& name) {
    pid_t pid = 0;
    while (pid == 0) std::ifstream(lease_of(name)) >> pid;
    return pid;
  }
  void expect_failed(const v1::Job& job, v1::Job::Reason reason, const std::string& text, int attempts) {
    EXPECT_EQ(job.state(), v1::Job::STATE_FAILED);
    EXPECT_EQ(job.state_reason(), reason) << job.state_message();
    EXPECT_THAT(job.state_message(), HasSubstr(text));
    EXPECT_EQ(job.attempt(), attempts);
  }

  TempFolder folder_;
  std::string program_ = SEAWAY_BUILD_DIR "/tests/seaway_fake_offline";
  std::unique_ptr<Daemon> daemon_;
  std::unique_ptr<JobClient> client_;
};

TEST_F(WorkerProcess, RunsAJobToTheSameBytesAsTheForegroundRun) {
  start("");
  const v1::Job job = run("plain");
  EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED) << job.state_message();
  EXPECT_EQ(job.attempt(), 1);
  EXPECT_EQ(csv(job.name()), unbroken());
  EXPECT_EQ(client_->stages(job.name()).stages_size(), 3);
  EXPECT_EQ(client_->artifacts(job.name()).artifacts_size(), 3);
  EXPECT_FALSE(fs::exists(lease_of(job.name())));
}

/// CPUs that the threads of a process may run on, all of them together.
std::set<int> cpus_of(pid_t pid) {
  std::set<int> out;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
    cpu_set_t set;
    if (::sched_getaffinity(std::stoi(task.path().filename()), sizeof set, &set) != 0) continue;  // it has just ended
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &set)) out.insert(cpu);
  }
  return out;
}

TEST_F(WorkerProcess, JobsKeepToTheirOwnCores) {
  const std::set<int> all = cpus_of(::getpid());
  if (all.size() < 2) GTEST_SKIP() << "there is one core";
  start("  count: 2\n  threads: 1\n", 3000);
  const std::string a = submit("one"), b = submit("another");
  for (const std::string& name : {a, b}) wait_for_samples(name, 20);
  const std::set<int> of_a = cpus_of(worker_of(a)), of_b = cpus_of(worker_of(b));
  EXPECT_EQ(of_a.size(), 1u);
  EXPECT_EQ(of_b.size(), 1u);
  EXPECT_NE(of_a, of_b);
  EXPECT_EQ(cpus_of(daemon_->process().pid()), all) << "the server keeps its own";
  const std::string expected = unbroken();
  for (const std::string& name : {a, b}) {
    EXPECT_EQ(ended(name).state(), v1::Job::STATE_SUCCEEDED);
    EXPECT_EQ(csv(name), expected);
  }
}

TEST_F(WorkerProcess, AJobThatMayUseAllCoresIsNotHeld) {
  start("  count: 1\n", 3000);
  const std::string job = submit("one");
  wait_for_samples(job, 20);
  EXPECT_EQ(cpus_of(worker_of(job)), cpus_of(::getpid()));
}

TEST_F(WorkerProcess, CrashesAreRetriedFromTheLastCheckpoint) {
  start("");
  const std::string segv = submit("fault segv@130x2"), fpe = submit("fault fpe@401x1"), exits = submit("fault exit@7x2");
  const std::string expected = unbroken();
  for (const auto& [name, attempts] : {std::pair{segv, 3}, {fpe, 2}, {exits, 3}}) {
    const v1::Job job = ended(name);
    EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED) << job.state_message();
    EXPECT_EQ(job.attempt(), attempts);
    EXPECT_EQ(csv(name), expected);
  }
  int resumed = 0;
  const v1::Job job = client_->get(segv, v1::JOB_VIEW_FULL);
  for (const auto& event : job.events())
    if (event.kind() == "RESUMED" && event.text() == "after sample 120") ++resumed;
  EXPECT_EQ(resumed, 2);
  EXPECT_EQ(daemon_->terminate(), 0) << "the server has survived all of it";
}

TEST_F(WorkerProcess, AfterTheAllowedAttemptsTheJobFailsWithItsReasonAndTheNextOneRuns) {
  // A sanitizer needs far more memory for itself than any limit here.
  constexpr bool limited = SEAWAY_SLOWDOWN == 1;
  start(std::string("  max_faults: 2\n  disk_mb: 20\n") + (limited ? "  memory_mb: 300\n" : ""));
  expect_failed(run("fault segv@130"), v1::Job::REASON_WORKER_CRASH, "SIGSEGV", 2);
  expect_failed(run("fault segv@1"), v1::Job::REASON_WORKER_CRASH, "about to follow a bad pointer", 2);
  expect_failed(run("fault fpe@1"), v1::Job::REASON_WORKER_CRASH, "SIGFPE", 2);
  expect_failed(run("fault exit@1"), v1::Job::REASON_WORKER_CRASH, "code 9", 2);
  if (limited) expect_failed(run("fault memory@50"), v1::Job::REASON_MEMORY, "memory", 2);
  expect_failed(run("fault disk@50"), v1::Job::REASON_DISK_FULL, "workers.disk_mb", 1);
  expect_failed(run("fault throw@50"), v1::Job::REASON_INTERNAL, "thrown on purpose", 1);
  EXPECT_EQ(run("plain").state(), v1::Job::STATE_SUCCEEDED);
  EXPECT_EQ(daemon_->terminate(), 0);
}

TEST_F(WorkerProcess, AProgramThatIsBeingUpgradedIsNoFaultOfAJob) {
  const std::string real = program_;
  program_ = folder_ / "seaway-run";
  const auto install = [&](const std::string& script) {
    std::ofstream(program_ + ".new") << script;
    fs::permissions(program_ + ".new", fs::perms::owner_all);
    fs::rename(program_ + ".new", program_);
  };
  const auto until_log = [&](const std::string& words) {
    for (int i = 0; i < 3000 && read_text(folder_ / "log.txt").find(words) == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_THAT(read_text(folder_ / "log.txt"), HasSubstr(words));
  };
  // The next version is there, and the server is still the one before.
  worker::Order order;
  order.set_code_version("another one");
  std::ofstream(folder_ / "order") << order.SerializeAsString();
  install("#!/bin/sh\nexec " + real + " attempt <" + (folder_ / "order") + "\n");
  start("  max_faults: 1\n");
  const std::string name = submit("plain");
  until_log("is of another version than this server; restart the server");
  fs::remove(program_);
  until_log("cannot be started: No such file");
  install("#!/bin/sh\nexec " + real + " attempt\n");
  const v1::Job job = ended(name);
  EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED) << job.state_message();
  EXPECT_EQ(job.fault_count(), 0);
  EXPECT_GT(job.attempt(), 2);
}

TEST_F(WorkerProcess, HangsAreFoundAndKilled) {
  start("  max_faults: 2\n  stall_timeout_s: 2\n  lease_s: 4\n");
  expect_failed(run("fault hang@1"), v1::Job::REASON_STALLED, "workers.stall_timeout_s", 2);
  const v1::Job job = run("fault hang@130x1");
  EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED) << job.state_message();
  EXPECT_EQ(job.attempt(), 2);
}

TEST_F(WorkerProcess, AWorkerWithoutASignOfLifeLosesItsLease) {
  start("  stall_timeout_s: 600\n  lease_s: 1\n");
  const v1::Job job = run("fault sleep@130x1");
  EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED) << job.state_message();
  EXPECT_EQ(job.attempt(), 2);
  bool told = false;
  for (const auto& event : job.events()) told = told || event.text().find("EXECUTOR_LOST") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST_F(WorkerProcess, ComputingTimeIsLimitedAndTheCheckpointStays) {
  start("  wall_s: 1\n", 5000);
  const v1::Job job = run("slow");
  expect_failed(job, v1::Job::REASON_TIME_LIMIT, "which is the limit", 1);
  EXPECT_GT(job.checkpoint_sequence(), 0);
  EXPECT_EQ(job.checkpoint_sequence(), job.latest_sequence()) << "it was asked to stop, not killed";
}

TEST_F(WorkerProcess, CancelStopsItAlsoIfItDoesNotListen) {
  start("  stop_grace_s: 0.5\n", 2000);
  const std::string good = submit("plain");
  wait_for_samples(good, 30);
  client_->cancel(good);
  const v1::Job cancelled = ended(good);
  EXPECT_EQ(cancelled.state(), v1::Job::STATE_CANCELLED);
  EXPECT_EQ(cancelled.checkpoint_sequence(), cancelled.latest_sequence());
  const std::string deaf = submit("fault deaf@5");
  wait_for_samples(deaf, 30);
  client_->cancel(deaf);
  EXPECT_EQ(ended(deaf).state(), v1::Job::STATE_CANCELLED);
}

TEST_F(WorkerProcess, KillNeedsNoConsentAndNoCheckpoint) {
  start("  stop_grace_s: 3600\n", 2000);
  const std::string deaf = submit("fault deaf@5");
  wait_for_samples(deaf, 60);
  client_->cancel(deaf);
  EXPECT_EQ(client_->get(deaf).state(), v1::Job::STATE_CANCELLING);
  client_->kill(deaf);
  const v1::Job killed = ended(deaf);
  EXPECT_EQ(killed.state(), v1::Job::STATE_CANCELLED);
  EXPECT_LT(killed.latest_sequence(), 600);
  EXPECT_EQ(killed.checkpoint_sequence() % 40, 0) << "only those that it had written anyway";
}

TEST_F(WorkerProcess, DiesWithTheServerAndTheNextOneGoesOn) {
  start("", 2000);
  const std::string name = submit("plain");
  wait_for_samples(name, 100);
  const pid_t worker = worker_of(name);
  daemon_->kill();
  while (::kill(worker, 0) == 0) {  // the system needs a moment; without the death signal this never ends
  }
  daemon_->start();
  const v1::Job job = ended(name);
  EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED);
  EXPECT_EQ(job.attempt(), 2);
  EXPECT_EQ(csv(name), unbroken());
}

TEST_F(WorkerProcess, StopOfTheServerTakesACheckpoint) {
  start("", 2000);
  const std::string name = submit("plain");
  wait_for_samples(name, 100);
  EXPECT_EQ(daemon_->terminate(), 0);
  daemon_->start();
  const v1::Job job = ended(name);
  EXPECT_EQ(job.state(), v1::Job::STATE_SUCCEEDED);
  EXPECT_EQ(job.attempt(), 2);
  EXPECT_EQ(csv(name), unbroken());
}

TEST_F(WorkerProcess, AWorkerLeftBehindIsEndedBeforeItsJobRunsAgain) {
  // As if the death signal had not come: a process that holds the lease and has written its number there.
  start("");
  const std::string name = submit("plain");
  ended(name);
  ASSERT_EQ(daemon_->terminate(), 0);
  const std::string lease = folder_ / "data/leases/left-behind";
  Process holder({"/usr/bin/flock", "--no-fork", lease, "/bin/sh", "-c", "echo $$ > " + lease + "; exec sleep 1000"});
  pid_t pid = 0;
  while (pid == 0) std::ifstream(lease) >> pid;
  daemon_->start();
  EXPECT_FALSE(fs::exists(lease));
  EXPECT_EQ(holder.wait(), 128 + SIGKILL);
}

TEST(Executors, ThreadStillWorksAndWrongProgramStopsTheStart) {
  TempFolder folder;
  std::ofstream(folder / "config.yaml") << "workers:\n  executor: process\n  program: /nowhere/seaway-run\n";
  const Finished wrong = run_program({SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", "-c", folder / "config.yaml", "--port", "0",
                                      "--data-dir", folder / "data"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("workers.program /nowhere/seaway-run"));
  const Finished by_hand = run_program({SEAWAY_BUILD_DIR "/tests/seaway_fake_offline", "attempt"});
  EXPECT_EQ(by_hand.code, 2);
  EXPECT_THAT(by_hand.output, HasSubstr("use seaway-run CASE"));
}

}  // namespace
}  // namespace seaway
