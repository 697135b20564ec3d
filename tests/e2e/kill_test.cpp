// SPDX-License-Identifier: GPL-3.0-or-later
// kill -9 of the server at random moments (F1 of the fault tests, short form): no acknowledged job and no
// sample that a client has received is lost, and the final history is that of an unbroken run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <mutex>
#include <random>
#include <thread>

#include "client/job_client.hpp"
#include "proto/history_csv.hpp"
#include "proto/yaml.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::JobClient;

v1::Case small() {
  v1::Case m;
  yaml::read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", m);
  return m;
}

std::string csv(JobClient& client, const std::string& name) {
  std::string out;
  client.history(name, [&](const v1::ReadSamplesResponse& page) { history_csv::append(page.chunk(), out); });
  return out;
}

/// Follows a job through all restarts, keeping what it was shown as the CSV of the history.
class Witness {
 public:
  Witness(const std::string& address, std::string name) : name_(std::move(name)), client_(address), thread_([this] { follow(); }) {}
  std::string wait() {
    thread_.join();
    return csv_;
  }
  std::int64_t last() const { return last_; }
  bool gap() const { return gap_; }

 private:
  void follow() {
    bool ended = false;
    while (!ended)
      client_.watch(name_, last_, [&](const v1::WatchSamplesResponse& m) {
        if (m.has_mark()) ended = m.mark().state() >= v1::Job::STATE_SUCCEEDED;
        if (!m.has_chunk()) return true;
        if (m.chunk().first_sequence() != last_ + 1) gap_ = true;
        last_ = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
        history_csv::append(m.chunk(), csv_);
        return true;
      });
  }
  const std::string name_;
  JobClient client_;
  std::string csv_;
  std::atomic<std::int64_t> last_{0};
  std::atomic<bool> gap_{false};
  std::jthread thread_;
};

TEST(Kill, AClientThatHasSeenALongAbsenceFindsTheNextServerWithinASecond) {
  TempFolder folder;
  Daemon daemon(SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", folder.path());
  daemon.start();
  JobClient client(daemon.address());
  EXPECT_EQ(client.list({}).jobs_size(), 0);
  for (const int absence_ms : {1000, 3500, 5500}) {
    daemon.kill();
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(absence_ms);
    while (std::chrono::steady_clock::now() < until) EXPECT_THROW(client.list({}), client::RpcError);
    daemon.start();
    const auto began = std::chrono::steady_clock::now();
    EXPECT_NO_THROW(client.list({})) << "after " << absence_ms << " ms";
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(2));
  }
}

TEST(Kill, LosesNoAcknowledgedJobAndNoReceivedSample) {
  TempFolder folder;
  const unsigned seed = std::getenv("SEAWAY_SEED") != nullptr ? static_cast<unsigned>(std::atoi(std::getenv("SEAWAY_SEED"))) : std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  std::printf("seed %u\n", seed);
  std::mt19937 random(seed);
  Daemon daemon(SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon", folder.path(),
                {"SEAWAY_FAKE_STEP_US=2000", "SEAWAY_FAKE_CHECKPOINT_STEPS=40"});
  daemon.start();
  std::vector<std::string> acknowledged;
  const auto submit = [&] {
    JobClient client(daemon.address());
    v1::CreateJobRequest request;
    *request.mutable_case_() = small();
    request.set_request_id(client::new_request_id());
    acknowledged.push_back(client.create(request).job().name());
  };
  submit();
  Witness witness(daemon.address(), acknowledged.front());
  for (int kills = 0; kills < 5; ++kills) {
    // A moment is a number of further samples that the witness has seen, plus a little.
    const std::int64_t until = std::min<std::int64_t>(590, witness.last() + static_cast<std::int64_t>(random() % 120));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (witness.last() < until && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    submit();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 30000));
    daemon.kill();
    daemon.start();
  }
  const std::string seen = witness.wait();
  EXPECT_FALSE(witness.gap());
  JobClient client(daemon.address());
  for (const std::string& name : acknowledged) {
    const auto job = client.get(name);
    if (job.state() == v1::Job::STATE_QUEUED) client.cancel(name);
  }
  EXPECT_GE(client.get(acknowledged.front()).attempt(), 2);
  const std::string final_history = csv(client, acknowledged.front());
  EXPECT_EQ(seen, final_history);
  const Finished unbroken = run_program({SEAWAY_BUILD_DIR "/tests/seaway_fake_offline", SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml",
                                         "-o", folder / "run", "-q"});
  ASSERT_EQ(unbroken.code, 0);
  const std::string text = read_text(folder / "run/history.csv");
  EXPECT_EQ(final_history, text.substr(text.find('\n') + 1));
}

}  // namespace
}  // namespace seaway
