// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of the programs' surroundings, by their numbers in tests/fault/README.md: names that are paths, signals, no
// descriptors left, a disk that loses data. The server runs as a program, with the stand-in solver in processes of its own.
#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

#include "client/job_client.hpp"
#include "proto/history_csv.hpp"
#include "proto/yaml.hpp"
#include "server/jobs/workspace.hpp"
#include "server/store/verify.hpp"
#include "tests/support/disk_full.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using ::testing::HasSubstr;
using client::JobClient;
using std::chrono::seconds;
namespace fs = std::filesystem;

class ServerFaults : public ::testing::Test {
 protected:
  void start(std::vector<std::string> environment = {}) {
    std::ofstream(folder_ / "config.yaml") << "workers:\n  executor: process\n  program: " SEAWAY_BUILD_DIR "/tests/seaway_fake_offline\n";
    environment.insert(environment.end(), {"SEAWAY_FAKE_STEP_US=1000", "SEAWAY_FAKE_CHECKPOINT_STEPS=40"});
    daemon_ = std::make_unique<Daemon>(SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", folder_.path(), environment,
                                       std::vector<std::string>{"--config", folder_ / "config.yaml"});
    daemon_->start();
    client_ = std::make_unique<JobClient>(daemon_->address());
  }
  /// For programs whose disk and threads the test controls by folder_ / "control".
  std::vector<std::string> under_control() {
    return {"LD_PRELOAD=" SEAWAY_BUILD_DIR "/tests/libseaway_disk_full.so", "SEAWAY_DISK_FULL_CONTROL=" + (folder_ / "control"),
            "SEAWAY_DISK_FULL_FOLDER=" + (folder_ / "data"), "ASAN_OPTIONS=verify_asan_link_order=0"};
  }
  v1::CreateJobRequest request(const std::string& title = "a case") {
    v1::CreateJobRequest out;
    yaml::read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", *out.mutable_case_());
    out.mutable_case_()->set_title(title);
    out.set_request_id(client::new_request_id());
    return out;
  }
  std::string submit(const std::string& title = "a case") { return client_->create(request(title)).job().name(); }
  /// False after a minute.
  bool reaches(const std::string& name, v1::Job::State state) {
    const auto deadline = std::chrono::steady_clock::now() + seconds(60);
    while (std::chrono::steady_clock::now() < deadline) {
      if (client_->get(name).state() == state) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }
  TempFolder folder_;
  std::unique_ptr<Daemon> daemon_;
  std::unique_ptr<JobClient> client_;
};

class F2 : public ServerFaults {};
class F6 : public ServerFaults {};
class F8 : public ServerFaults {};
class F16 : public ServerFaults {};
class F20 : public ServerFaults {};
class F21 : public ServerFaults {};

TEST_F(F6, AFailedSyncEndsTheServerAndTheNextStartHasAllThatWasAcknowledged) {
  SharedDiskControl disk(folder_ / "control");
  start(under_control());
  auto held = request();
  held.set_start_held(true);
  const std::string kept = client_->create(held).job().name();
  disk->syncs_fail = 1;
  EXPECT_THROW(client_->create(request("another one")), client::RpcError);
  std::string log;
  for (int i = 0; i < 200 && log.find("event=sync_failed") == log.npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    log = read_text(folder_ / "log.txt");
  }
  EXPECT_THAT(log, HasSubstr("event=sync_failed"));
  EXPECT_EQ(daemon_->terminate(), 1) << "it should have ended by itself";
  disk->syncs_fail = 0;
  daemon_->start();
  client_ = std::make_unique<JobClient>(daemon_->address());
  EXPECT_EQ(client_->get(kept).state(), v1::Job::STATE_HELD);
  EXPECT_EQ(daemon_->terminate(), 0);
  EXPECT_TRUE(store::verify_database(folder_ / "data/seaway.db").problems.empty());
}

TEST_F(F2, ABackupThatIsKilledLeavesNoHalfCopy) {
  start();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(reaches(submit(), v1::Job::STATE_SUCCEEDED));  // histories to copy
  int whole = 0, none = 0;
  for (int ms = 0; ms < 60 || (whole == 0 && ms < 2000); ms += 2) {
    const std::string copy = folder_ / ("copy" + std::to_string(ms) + ".db");
    Process backup({SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", "--data-dir", folder_ / "data", "backup", copy});
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    backup.signal(SIGKILL);
    backup.wait();
    if (!fs::exists(copy)) {
      ++none;
      continue;
    }
    ++whole;
    const auto found = store::verify_database(copy);
    EXPECT_TRUE(found.problems.empty());
    EXPECT_EQ(found.samples, 3000);
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(none, 0) << "none was killed in time: nothing is tested";
}

TEST_F(F8, ABackupThatIsPutBackGoesOnToTheSameBits) {
  start();
  const auto history = [&](const std::string& name) {
    std::string out;
    client_->history(name, [&](const v1::ReadSamplesResponse& page) { history_csv::append(page.chunk(), out); });
    return out;
  };
  const std::string name = submit();
  while (client_->get(name).checkpoint_sequence() < 150) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const Finished backup = run_program({SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", "--data-dir", folder_ / "data", "backup", folder_ / "copy.db"});
  ASSERT_EQ(backup.code, 0) << backup.output;
  ASSERT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED));
  const std::string expected = history(name);
  for (const bool with_files : {true, false}) {
    EXPECT_EQ(daemon_->terminate(), 0);
    for (const char* file : {"/seaway.db-wal", "/seaway.db-shm"}) fs::remove((folder_ / "data") + file);
    fs::copy_file(folder_ / "copy.db", folder_ / "data/seaway.db", fs::copy_options::overwrite_existing);
    if (!with_files) fs::remove_all(folder_ / ("data/jobs/" + name.substr(5)));
    daemon_->start();
    client_ = std::make_unique<JobClient>(daemon_->address());
    EXPECT_LT(client_->get(name).latest_sequence(), 600) << "this is not the backup";
    ASSERT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED)) << client_->get(name).state_message();
    EXPECT_EQ(history(name), expected);
    const v1::Job job = client_->get(name, v1::JOB_VIEW_FULL);
    for (const auto& event : job.events()) EXPECT_NE(event.kind(), "REPLAY_MISMATCH") << event.text();
  }
}

/// Names, sizes and contents of all files below, but for what lies in `without`.
std::string tree_digest(const std::string& root, const std::string& without) {
  std::vector<std::string> all;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->path() == without) {
      entry.disable_recursion_pending();
      continue;
    }
    all.push_back(entry->path().string() + (entry->is_regular_file() ? jobs::sha256_hex(read_text(entry->path())) : ""));
  }
  std::sort(all.begin(), all.end());
  std::string text;
  for (const std::string& one : all) text += one + "\n";
  return text;
}

TEST_F(F16, NamesThatArePathsTouchNothingOutsideTheDataFolder) {
  start();
  const std::string log = folder_ / "log.txt", outside = folder_ / "outside";
  fs::create_directories(outside);
  std::ofstream(outside + "/victim") << "as it was";
  const std::string before = tree_digest(outside, "");
  const std::vector<std::string> names{"../../outside/victim", outside + "/victim", "CON", "a\nb", std::string(4096, 'a'),
                                       "\xe2\x80\xaegnp.exe", "..", ".", "data/../../outside/new", "~/x", "$(touch " + outside + "/new)"};
  for (const std::string& name : names) {
    auto wanted = request("run of " + name.substr(0, 20));
    wanted.mutable_case_()->set_title("a title");
    auto& hull = *wanted.mutable_case_()->mutable_hull();
    hull.clear_compartments();
    hull.mutable_offsets_section()->set_file(name);
    hull.mutable_offsets_section()->set_station(5);
    auto& file = *wanted.add_files();
    file.set_name(name);
    file.set_content("station,z,half_breadth\n5,0,0.1\n5,0.1,0.15\n");
    wanted.set_note(name == "a\nb" ? "" : name.substr(0, 100));
    try {
      const std::string job = client_->create(wanted).job().name();
      EXPECT_EQ(job.find_first_of("./\\", 5), job.npos) << job;
    } catch (const client::RpcError& error) {
      EXPECT_EQ(error.status(), grpc::StatusCode::INVALID_ARGUMENT) << error.what();
    }
    EXPECT_THROW(client_->get("jobs/" + name), client::RpcError) << name;
    EXPECT_THROW(client_->erase("jobs/" + name), client::RpcError) << name;
  }
  EXPECT_EQ(tree_digest(outside, ""), before);
  for (const auto& entry : fs::directory_iterator(folder_ / "data/files"))
    EXPECT_EQ(entry.path().filename().string().size(), 64u) << "not under its digest: " << entry.path();
}

TEST_F(F16, ALinkPlantedInARunsFolderIsNotFollowed) {
  start();
  const std::string name = submit();
  ASSERT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED));
  const std::string outside = folder_ / "victim";
  std::ofstream(outside) << "as it was";
  // In the place of an artifact: its download must not show the other file.
  const std::string run = folder_ / ("data/jobs/" + name.substr(5));
  const auto artifacts = client_->artifacts(name);
  ASSERT_GT(artifacts.artifacts_size(), 0);
  const std::string artifact = artifacts.artifacts(0).name();
  fs::remove(run + "/" + artifact);
  fs::create_symlink(outside, run + "/" + artifact);
  std::string got;
  EXPECT_THROW(client_->download(name, artifact, [&](const std::string& part) { got += part; }), client::RpcError);
  EXPECT_EQ(got, "");
  // In the place of a checkpoint, and as a folder: a retry takes neither, and deleting takes the links alone.
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().extension() == ".checkpoint") {
      fs::remove(entry.path());
      fs::create_symlink(outside, entry.path());
    }
  v1::RetryJobRequest retry;
  retry.set_name(name);
  retry.set_request_id(client::new_request_id());
  retry.set_from(v1::RetryJobRequest::FROM_LAST_CHECKPOINT);
  EXPECT_THROW(client_->retry(retry), client::RpcError);
  client_->erase(name);
  EXPECT_FALSE(fs::exists(run));
  EXPECT_EQ(read_text(outside), "as it was");
}

TEST_F(F20, TheManagerIsToldWhenItAnswersAndWhenItStops) {
  const std::string name = folder_ / "notify";
  const int manager = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(name.size(), sizeof address.sun_path);
  std::strcpy(address.sun_path, name.c_str());
  ASSERT_EQ(::bind(manager, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const timeval patience{30, 0};
  ::setsockopt(manager, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  const auto told = [&] {
    char text[64];
    const ssize_t n = ::recv(manager, text, sizeof text, 0);
    return std::string(text, static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  };
  start({"NOTIFY_SOCKET=" + name});
  EXPECT_EQ(told(), "READY=1");
  EXPECT_EQ(client_->list({}).jobs_size(), 0);
  EXPECT_EQ(daemon_->terminate(), 0);
  EXPECT_EQ(told(), "STOPPING=1");
  ::close(manager);
}

TEST_F(F20, ASecondSignalChangesNothing) {
  start();
  const std::string name = submit();
  while (client_->get(name).latest_sequence() < 50) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  daemon_->process().signal(SIGTERM);
  daemon_->process().signal(SIGINT);
  EXPECT_EQ(daemon_->terminate(), 0);  // the third one
  daemon_->start();
  EXPECT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED));
  EXPECT_EQ(client_->get(name).latest_sequence(), 600);
}

/// Whether a process has come so far that it takes SIGTERM for a request: its threads block it. (The one that waits for it
/// does not while it waits.)
bool waits_for_signals(pid_t pid) {
  std::error_code gone;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", gone)) {
    const std::string status = read_text(thread.path() / "status");
    const std::size_t at = status.find("SigBlk:");
    if (at != status.npos && (std::stoull(status.substr(at + 7), nullptr, 16) >> (SIGTERM - 1) & 1) != 0) return true;
  }
  return false;
}

TEST_F(F20, ASignalAtTheStartOrInTheRecoveryIsHeard) {
  start();
  const std::string name = submit();
  while (client_->get(name).latest_sequence() < 50) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  daemon_->kill();  // there is something to recover
  int in_time = 0;
  for (const int ms : {0, 2, 5, 10, 20, 40, 80, 160, 320, 640}) {
    Process early({SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", "--config", folder_ / "config.yaml", "--data-dir", folder_ / "data", "--port", "0"},
                  folder_ / "early.txt");
    std::this_thread::sleep_for(std::chrono::milliseconds(ms * SEAWAY_SLOWDOWN));
    const bool is_itself = waits_for_signals(early.pid());
    in_time += is_itself ? 1 : 0;
    early.signal(SIGTERM);
    const int code = early.wait_for(seconds(10 * SEAWAY_SLOWDOWN));
    // Before the program has come to itself the signal ends it as any other.
    EXPECT_TRUE(code == 0 || (!is_itself && code == 128 + SIGTERM)) << code << " after " << ms << " ms\n" << read_text(folder_ / "early.txt");
  }
  EXPECT_GT(in_time, 0) << "each signal came before the program was itself: nothing is tested";
  daemon_->start();
  EXPECT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED));
  EXPECT_EQ(client_->get(name).latest_sequence(), 600);
}

TEST_F(F20, AStopRightAfterTheStartIsNoFaultOfTheJob) {
  start();
  const std::string name = submit();
  EXPECT_EQ(daemon_->terminate(), 0);
  for (int ms = 0; ms < 24; ms += 2) {  // the worker is started, or has just begun
    daemon_->start();
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    EXPECT_EQ(daemon_->terminate(), 0);
  }
  daemon_->start();
  EXPECT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED));
  const v1::Job job = client_->get(name, v1::JOB_VIEW_FULL);
  EXPECT_EQ(job.latest_sequence(), 600);
  for (const auto& event : job.events()) EXPECT_THAT(event.text(), ::testing::Not(HasSubstr("WORKER_CRASH")));
}

TEST_F(F20, AServerThatCannotListenTakesNoJob) {
  start();
  const std::string name = submit();
  while (client_->get(name).latest_sequence() < 50) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  daemon_->kill();
  TempFolder elsewhere;
  Daemon in_the_way(SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", elsewhere.path());
  in_the_way.start();
  const std::string port = in_the_way.address().substr(in_the_way.address().rfind(':') + 1);
  for (int i = 0; i < 4; ++i) {
    const Finished late = run_program({SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", "--config", folder_ / "config.yaml", "--data-dir",
                                       folder_ / "data", "--port", port});
    EXPECT_EQ(late.code, 1);
    EXPECT_THAT(late.output, HasSubstr("is another server running there?"));
  }
  daemon_->start();
  EXPECT_TRUE(reaches(name, v1::Job::STATE_SUCCEEDED));
  EXPECT_EQ(client_->get(name).attempt(), 2);
}

TEST_F(F21, WithoutDescriptorsCallsFailOrWaitAndTheServerLives) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "UBSan looks whether an address can be read with a pipe of its own, and takes its want for a wrong object";
#endif
  start();
  const pid_t server = daemon_->process().pid();
  const std::string first = submit();
  ASSERT_TRUE(reaches(first, v1::Job::STATE_SUCCEEDED));
  rlimit normal{};
  ASSERT_EQ(::prlimit(server, RLIMIT_NOFILE, nullptr, &normal), 0);
  const auto open = static_cast<rlim_t>(std::distance(fs::directory_iterator("/proc/" + std::to_string(server) + "/fd"), fs::directory_iterator{}));
  // None for a new connection, a file of a case, or the pipes of a worker.
  rlimit none = normal;
  none.rlim_cur = open;
  ASSERT_EQ(::prlimit(server, RLIMIT_NOFILE, &none, nullptr), 0);
  const std::string starved = submit();
  for (int i = 0; i < 20; ++i) {
    JobClient other(daemon_->address());
    try {
      other.list({});
    } catch (const client::RpcError& error) {
      EXPECT_THAT((std::vector{grpc::StatusCode::UNAVAILABLE, grpc::StatusCode::DEADLINE_EXCEEDED}), ::testing::Contains(error.status()));
      break;  // one of them has waited long enough
    }
  }
  EXPECT_NE(client_->get(starved).state(), v1::Job::STATE_SUCCEEDED) << "it has run without a pipe: nothing is tested";
  EXPECT_EQ(client_->get(first).state(), v1::Job::STATE_SUCCEEDED);
  ASSERT_EQ(::prlimit(server, RLIMIT_NOFILE, &normal, nullptr), 0);
  const v1::Job::State end = reaches(starved, v1::Job::STATE_SUCCEEDED) ? v1::Job::STATE_SUCCEEDED : client_->get(starved).state();
  EXPECT_EQ(end, v1::Job::STATE_SUCCEEDED) << client_->get(starved).state_message() << "\n" << read_text(folder_ / "log.txt");
  EXPECT_EQ(client_->get(starved).fault_count(), 0) << "the want of the machine is no fault of the job";
  JobClient other(daemon_->address());
  EXPECT_EQ(other.list({}).jobs_size(), 2);
}

/// Lists, gets and watches at once over one connection, so that threads of the server meet on it. Throws what a call throws.
void call_in_parallel(const std::string& address, const std::string& job, int callers, int rounds) {
  const auto channel = grpc::CreateChannel(address, grpc::InsecureChannelCredentials());
  std::vector<std::future<void>> all;
  for (int i = 0; i < callers; ++i)
    all.push_back(std::async(std::launch::async, [&] {
      JobClient client(channel);
      for (int n = 0; n < rounds; ++n) {
        EXPECT_GE(client.list({}).jobs_size(), 1);
        EXPECT_EQ(client.get(job).name(), job);
        client.watch(job, 590, [](const auto&) { return true; });
      }
    }));
  for (auto& one : all) one.get();
}

TEST_F(F21, WithoutThreadsCallsAreAnsweredAndTheServerLives) {
  SharedDiskControl system(folder_ / "control");
  start(under_control());
  const std::string first = submit();
  ASSERT_TRUE(reaches(first, v1::Job::STATE_SUCCEEDED));
  system->threads_fail = 1;
  const std::string starved = submit();
  for (int i = 0; i < 40; ++i) {  // connections, calls and streams without a thread more
    JobClient other(daemon_->address());
    EXPECT_GE(other.list({}).jobs_size(), 2);
    other.watch(first, 590, [](const auto&) { return true; });
  }
  call_in_parallel(daemon_->address(), first, 16, 10);
  const auto deadline = std::chrono::steady_clock::now() + seconds(30);
  while (system->threads_refused == 0 && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_GT(system->threads_refused, 0);
  EXPECT_NE(client_->get(starved).state(), v1::Job::STATE_SUCCEEDED) << "it has run: nothing is tested";
  system->threads_fail = 0;
  EXPECT_TRUE(reaches(starved, v1::Job::STATE_SUCCEEDED)) << client_->get(starved).state_message() << "\n" << read_text(folder_ / "log.txt");
  EXPECT_EQ(client_->get(starved).fault_count(), 0);
  EXPECT_EQ(daemon_->terminate(), 0);
}

TEST_F(F21, WithoutThreadsASignalEndsTheServerInTime) {
  SharedDiskControl system(folder_ / "control");
  start(under_control());
  system->threads_fail = 1;
  const std::string starved = submit();
  const auto told = std::chrono::steady_clock::now();
  EXPECT_EQ(daemon_->terminate(), 0) << read_text(folder_ / "log.txt");
  EXPECT_LT(std::chrono::steady_clock::now() - told, seconds(10));
  EXPECT_THAT(read_text(folder_ / "log.txt"), HasSubstr("event=stopped")) << "the end of its patience was needed";
  system->threads_fail = 0;
  daemon_->start();
  client_ = std::make_unique<JobClient>(daemon_->address());
  EXPECT_TRUE(reaches(starved, v1::Job::STATE_SUCCEEDED));
}

}  // namespace
}  // namespace seaway
