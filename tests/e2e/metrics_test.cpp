// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers for Prometheus, read from a running server over HTTP.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "client/job_client.hpp"
#include "proto/yaml.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using ::testing::HasSubstr;

const std::string program = SEAWAY_BUILD_DIR "/tests/seaway_fake_daemon";

v1::CreateJobRequest small_request() {
  v1::CreateJobRequest request;
  yaml::read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", *request.mutable_case_());
  request.set_request_id(client::new_request_id());
  return request;
}

class MetricsPage : public ::testing::Test {
 protected:
  void start(std::vector<std::string> environment = {}) {
    std::ofstream(folder_ / "config.yaml") << "metrics: {port: 0}\n";
    daemon_ = std::make_unique<Daemon>(program, folder_.path(), std::move(environment), std::vector<std::string>{"-c", folder_ / "config.yaml"});
    daemon_->start();
  }
  /// Where the last start listens, as its log says.
  std::string address() const {
    const std::string log = read_text(folder_ / "log.txt"), key = "event=metrics address=";
    const std::size_t at = log.rfind(key) + key.size();
    return log.substr(at, log.find('\n', at) - at);
  }
  std::string page() const {
    const auto answer = httplib::Client("http://" + address()).Get("/metrics");
    return answer && answer->status == 200 ? answer->body : "no answer";
  }
  Finished refused(const std::string& config) const {
    std::ofstream(folder_ / "wrong.yaml") << config;
    return run_program({program, "-c", folder_ / "wrong.yaml", "--port", "0", "--data-dir", folder_ / "other"});
  }
  TempFolder folder_;
  std::unique_ptr<Daemon> daemon_;
};

TEST_F(MetricsPage, ShowsWhatARunDoes) {
  start();
  client::JobClient client(daemon_->address());
  const std::string job = client.create(small_request()).job().name();
  ASSERT_TRUE(client.watch(job, 0, [](const auto&) { return true; }).ok());
  const std::string text = page();
  for (const char* line : {"seaway_jobs{state=\"SUCCEEDED\"} 1\n", "seaway_jobs{state=\"QUEUED\"} 0\n", "seaway_steps_total 600\n",
                           "seaway_queue_wait_seconds_count 1\n", "seaway_stage_seconds_count{phase=\"pressure\",stage=\"2\"} 1\n",
                           "seaway_checkpoint_seconds_count 3\n", "seaway_recoveries_total 0\n", "seaway_stream_lag_samples 0\n"})
    EXPECT_THAT(text, HasSubstr(line));
  for (const char* none : {"seaway_wal_bytes 0\n", "seaway_disk_free_bytes 0\n", "seaway_commit_seconds_count 0\n", "seaway_cell_updates_per_second 0\n"})
    EXPECT_THAT(text, ::testing::Not(HasSubstr(none)));
  EXPECT_EQ(text.find(job.substr(5)), text.npos) << "no job among the labels";
  EXPECT_EQ(daemon_->terminate(), 0);
}

TEST_F(MetricsPage, ShowsStreamsAndRecoveries) {
  start({"SEAWAY_FAKE_STEP_US=20000"});
  client::JobClient client(daemon_->address());
  const std::string job = client.create(small_request()).job().name();
  std::mutex mutex;
  std::condition_variable wake;
  bool open = false;
  std::jthread watcher([&] {
    client::JobClient(daemon_->address()).watch(job, 0, [&](const v1::WatchSamplesResponse& m) {
      const std::lock_guard lock(mutex);
      open = open || m.has_chunk();
      wake.notify_all();
      return true;
    });
  });
  {
    std::unique_lock lock(mutex);
    ASSERT_TRUE(wake.wait_for(lock, std::chrono::seconds(30), [&] { return open; }));
  }
  EXPECT_THAT(page(), HasSubstr("seaway_streams{kind=\"samples\"} 1\n"));
  daemon_->kill();
  watcher.join();
  daemon_->start();
  EXPECT_THAT(page(), HasSubstr("seaway_recoveries_total 1\n"));
}

TEST_F(MetricsPage, AnswersNothingElse) {
  start();
  httplib::Client http("http://" + address());
  EXPECT_EQ(http.Get("/")->status, 404);
  EXPECT_EQ(http.Get("/../../etc/passwd")->status, 404);
  EXPECT_EQ(http.Post("/metrics", "a", "text/plain")->status, 404);
  EXPECT_EQ(http.Post("/metrics", std::string(100'000, 'a'), "text/plain")->status, 413);
  EXPECT_THAT(page(), HasSubstr("seaway_jobs")) << "and lives on";
}

TEST_F(MetricsPage, StaysAwayWithoutAPortAndFromOtherAddresses) {
  daemon_ = std::make_unique<Daemon>(program, folder_.path());
  daemon_->start();
  EXPECT_EQ(read_text(folder_ / "log.txt").find("event=metrics"), std::string::npos);
  const Finished open = refused("metrics: {address: 0.0.0.0, port: 0}\n");
  EXPECT_EQ(open.code, 2);
  EXPECT_THAT(open.output, HasSubstr("only loopback addresses"));
  EXPECT_EQ(refused("metrics: {address: 127.example.org, port: 0}\n").code, 2) << "that may be anybody's";
  const Finished half = refused("metrics: {address: 127.0.0.1}\n");
  EXPECT_EQ(half.code, 2);
  EXPECT_THAT(half.output, HasSubstr("metrics.port: is missing"));
  const std::string taken = daemon_->address().substr(daemon_->address().rfind(':') + 1);
  const Finished busy = refused("metrics: {port: " + taken + "}\n");
  EXPECT_EQ(busy.code, 1);
  EXPECT_THAT(busy.output, HasSubstr("is another server running there?"));
}

}  // namespace
}  // namespace seaway
