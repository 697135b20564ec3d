// SPDX-License-Identifier: GPL-3.0-or-later
// kill: kill -9 of seawayd and of its workers at random moments of runs, while others submit, cancel and wait in the
// queue. What was acknowledged and what a client has received must survive, and the final history must be that of
// an unbroken run.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <random>
#include <thread>

#include "tests/fault/stress.hpp"
#include "tests/fault/witness.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

std::int64_t count_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

/// Lines of `seen` that are not where they should be in `stored`.
std::int64_t lost_lines(const std::string& seen, const std::string& stored) {
  if (stored.starts_with(seen)) return 0;
  std::int64_t lost = 0;
  for (std::size_t a = 0, b = 0; a < seen.size();) {
    const std::size_t a_end = seen.find('\n', a), b_end = stored.find('\n', b);
    const bool same = b < stored.size() && seen.compare(a, a_end - a, stored, b, b_end - b) == 0;
    lost += same ? 0 : 1;
    a = a_end + 1;
    b = b_end == std::string::npos ? stored.size() : b_end + 1;
  }
  return lost;
}

/// Says how the history of a run that was killed differs from the unbroken one.
void explain(const v1::Job& job, const std::string& got, const std::string& expected) {
  const auto first = std::mismatch(got.begin(), got.end(), expected.begin(), expected.end());
  const auto line_at = [](const std::string& text, std::string::const_iterator at) {
    const auto from = static_cast<std::size_t>(at - text.begin());
    const std::size_t begin = from == 0 ? 0 : text.rfind('\n', from - 1) + 1;
    return text.substr(begin, text.find('\n', from) - begin);
  };
  std::fprintf(stderr, "kill: %s ended in state %d (%s) after %d attempts, with %lld samples of %lld; the first line that differs, and as it should be:\n%s\n%s\n",
               job.name().c_str(), static_cast<int>(job.state()), job.state_message().c_str(), job.attempt(),
               static_cast<long long>(count_lines(got)), static_cast<long long>(count_lines(expected)),
               line_at(got, first.first).c_str(), line_at(expected, first.second).c_str());
  for (const auto& event : job.events())
    if (event.kind() != "STATE") std::fprintf(stderr, "kill: attempt %d %s %s\n", event.attempt(), event.kind().c_str(), event.text().c_str());
}

/// A submit whose answer may be lost: only an acknowledged one counts.
class RacingSubmit {
 public:
  RacingSubmit(const std::string& address, v1::CreateJobRequest request)
      : thread_([this, address, request = std::move(request)] {
          try {
            client::JobClient client(address);
            name_ = client.create(request).job().name();
          } catch (const client::ClientError&) {
          }
        }) {}
  std::optional<std::string> wait() {
    thread_.join();
    return name_;
  }

 private:
  std::optional<std::string> name_;
  std::thread thread_;
};

}  // namespace

std::vector<Line> kill(const Settings& s) {
  const testing::TempFolder folder;
  std::fprintf(stderr, "kill: seed %u\n", s.seed);
  std::mt19937 random(s.seed);
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  std::vector<std::string> acknowledged;
  const auto submit = [&] {
    client::JobClient client(daemon.address());
    const auto request = request_of(s.case_file);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (;;) {
      try {
        acknowledged.push_back(client.create(request).job().name());
        return;
      } catch (const client::RpcError& error) {
        // On a busy machine the connection to a server that has just begun takes its time.
        if (error.code() != client::exit_unreachable || std::chrono::steady_clock::now() > deadline) throw;
      }
    }
  };
  std::vector<std::string> cancelled;  // acknowledged as such
  int done = 0, workers = 0;
  std::int64_t samples_lost = 0;
  std::vector<std::string> histories;
  std::vector<v1::Job> ends;  ///< of the jobs that they belong to
  // A short case may end before all kills have hit it: then it runs again.
  for (int round = 0; done < s.kills && round < s.kills; ++round) {
    const std::size_t first = acknowledged.size();
    submit();
    Witness witness(daemon.address(), acknowledged.back());
    std::vector<double> moments;
    for (int i = done; i < s.kills; ++i) moments.push_back(std::uniform_real_distribution<>(0.0, 0.98)(random));
    std::sort(moments.begin(), moments.end());
    for (const double moment : moments) {
      while (witness.fraction() < moment && !witness.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 100'000));
      if (witness.ended()) break;
      if (random() % 2 == 0 && kill_worker(folder / "data")) {
        ++workers;
      } else {
        // Something is under way each time: a submit, a cancel, a job that is about to be taken.
        submit();
        RacingSubmit racing(daemon.address(), request_of(s.case_file));
        if (random() % 2 == 0) {
          client::JobClient client(daemon.address());
          if (client.cancel(acknowledged.back()).state() == v1::Job::STATE_CANCELLED) cancelled.push_back(acknowledged.back());
        }
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
        daemon.kill();
        daemon.start();
        if (auto name = racing.wait()) acknowledged.push_back(*name);
      }
      ++done;
    }
    const std::string& seen = witness.wait();
    client::JobClient client(daemon.address());
    histories.push_back(history_csv_of(client, acknowledged[first]));
    ends.push_back(client.get(acknowledged[first], v1::JOB_VIEW_FULL));
    samples_lost += lost_lines(seen, histories.back());
    for (std::size_t i = first + 1; i < acknowledged.size(); ++i) {
      try {
        client.cancel(acknowledged[i]);
      } catch (const client::RpcError&) {
        // It has run meanwhile, or it is lost; that is counted below.
      }
    }
  }
  client::JobClient client(daemon.address());
  int jobs_lost = 0;
  for (const std::string& name : acknowledged) {
    try {
      client.get(name);
    } catch (const client::RpcError& error) {
      jobs_lost += error.status() == grpc::StatusCode::NOT_FOUND ? 1 : 0;
    }
  }
  for (const std::string& name : cancelled) jobs_lost += client.get(name).state() != v1::Job::STATE_CANCELLED ? 1 : 0;
  daemon.terminate();
  const std::string expected = unbroken_csv(s, folder.path());
  std::fprintf(stderr, "kill: %d kills (%d of workers) over %zu runs of %lld samples, %zu jobs acknowledged, %zu cancelled\n",
               done, workers, histories.size(), static_cast<long long>(count_lines(expected)), acknowledged.size(),
               cancelled.size());
  if (done < s.kills) throw std::runtime_error("kill: the run ended before it was killed often enough");
  for (std::size_t i = 0; i < histories.size(); ++i)
    if (histories[i] != expected) explain(ends[i], histories[i], expected);
  const auto different = std::count_if(histories.begin(), histories.end(), [&](const auto& h) { return h != expected; });
  return {{"kill", "jobs_lost", static_cast<double>(jobs_lost), "1", 0, 0},
          {"kill", "samples_lost", static_cast<double>(samples_lost), "1", 0, 0},
          {"kill", "histories_different", static_cast<double>(different), "1", 0, 0}};
}

}  // namespace seaway::stress
