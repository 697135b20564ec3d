// SPDX-License-Identifier: GPL-3.0-or-later
// watch: follow a job live; a broken connection is taken up again after the last sample received.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "client/commands/commands.hpp"
#include "proto/json.hpp"
#include "proto/report_text.hpp"

namespace seaway::client {
namespace {

using Clock = std::chrono::steady_clock;

/// One line that is redrawn on a terminal; elsewhere a line a second, and one for every change.
class LiveLine {
 public:
  LiveLine() : tty_(::isatty(STDOUT_FILENO) != 0) {}
  void show(const std::string& text, bool important) {
    const auto now = Clock::now();
    if (!important && now - shown_ < (tty_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(1000))) return;
    shown_ = now;
    if (tty_) {
      std::printf("\r%s\033[K", text.c_str());
      open_ = true;
    } else {
      std::printf("%s\n", text.c_str());
    }
    std::fflush(stdout);
  }
  /// A line of its own that stays.
  void say(const std::string& text) {
    end();
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
  }
  void end() {
    if (open_) std::printf("\n");
    open_ = false;
    std::fflush(stdout);
  }

 private:
  const bool tty_;
  bool open_ = false;
  Clock::time_point shown_{};
};

class Follower {
 public:
  Follower(std::int64_t after, bool json) : after_(after), json_(json) {}

  void take(const v1::WatchSamplesResponse& m) {
    if (json_) {
      std::printf("%s\n", to_json(m).c_str());
      std::fflush(stdout);
    }
    if (m.has_header()) take_header(m.header());
    if (m.has_chunk()) take_chunk(m.chunk());
    if (m.has_mark()) take_mark(m.mark());
  }
  void lost(const std::string& why) {
    if (!json_) line_.say("connection lost (" + why + "); trying again");
  }
  void end() {
    if (!json_) line_.end();
  }
  std::int64_t after() const { return after_; }
  const v1::ProgressMark& mark() const { return mark_; }
  bool ended() const { return mark_.state() >= v1::Job::STATE_SUCCEEDED; }

 private:
  void take_header(const v1::StreamHeader& h) {
    heave_ = roll_ = -1;
    for (int i = 0; i < h.channels_size(); ++i) {
      if (h.channels(i).name() == "heave") heave_ = i;
      if (h.channels(i).name() == "roll") roll_ = i;
    }
    if (attempt_ >= 1 && h.attempt() > attempt_ && !json_) line_.say("attempt " + std::to_string(h.attempt()) + " begins");
    attempt_ = h.attempt();
  }
  void take_chunk(const v1::SampleChunk& c) {
    if (c.first_sequence() != after_ + 1)
      throw ClientError(exit_failed, "sample " + std::to_string(c.first_sequence()) + " came after " + std::to_string(after_));
    after_ += c.times_s_size();
    const int last = c.times_s_size() - 1;
    time_ = c.times_s(last);
    motion_ = {};
    char text[64];
    if (heave_ >= 0) {
      std::snprintf(text, sizeof text, "  heave %+7.1f mm", 1000 * c.columns(heave_).values(last));
      motion_ += text;
    }
    if (roll_ >= 0) {
      std::snprintf(text, sizeof text, "  roll %+7.2f deg", c.columns(roll_).values(last));
      motion_ += text;
    }
    show(false);
  }
  void take_mark(const v1::ProgressMark& m) {
    const bool turned = m.state() != mark_.state() || m.progress().stage() != mark_.progress().stage() ||
                        m.progress().held() != mark_.progress().held();
    mark_ = m;
    show(turned);
  }
  void show(bool important) {
    if (json_) return;
    const v1::Progress& p = mark_.progress();
    char text[200];
    if (p.stage_count() == 0) {
      line_.show(state_text(mark_.state()), important);
      return;
    }
    std::snprintf(text, sizeof text, "%s  stage %d/%d  %3.0f %%  t %6.2f s  left %s%s", state_text(mark_.state()).c_str(),
                  p.stage() + 1, p.stage_count(), 100 * p.fraction(), std::max(time_, p.time_s()),
                  p.has_remaining_s() ? report_text::duration(p.remaining_s()).c_str() : "?", p.held() ? "  (held)" : "");
    line_.show(text + motion_, important);
  }

  std::int64_t after_;
  const bool json_;
  LiveLine line_;
  v1::ProgressMark mark_;
  int heave_ = -1, roll_ = -1, attempt_ = 0;
  double time_ = 0;
  std::string motion_;
};

}  // namespace

int follow(JobClient& client, const std::string& name, std::int64_t after, bool json, double give_up_s) {
  Follower follower(after, json);
  auto reached = Clock::now();
  while (!follower.ended()) {
    const grpc::Status status = client.watch(name, follower.after(), [&](const v1::WatchSamplesResponse& m) {
      reached = Clock::now();
      follower.take(m);
      return true;
    });
    if (status.ok()) {
      if (!follower.ended()) throw ClientError(exit_failed, "the stream ended before the job");
      break;
    }
    const auto code = status.error_code();
    const bool again = code == grpc::StatusCode::UNAVAILABLE || code == grpc::StatusCode::INTERNAL ||
                       code == grpc::StatusCode::CANCELLED || code == grpc::StatusCode::DEADLINE_EXCEEDED;
    if (!again) throw RpcError(status);
    const bool tired = give_up_s > 0 && Clock::now() - reached > std::chrono::duration<double>(give_up_s);
    if (tired) throw RpcError(status);
    follower.lost(status.error_message());
    client.pause(std::chrono::milliseconds(500));
  }
  follower.end();
  const v1::ProgressMark& mark = follower.mark();
  if (!json) {
    std::printf("%s %s%s\n\n%s", name.c_str(), state_text(mark.state()).c_str(),
                reason_text(mark.state_reason(), mark.state_message()).c_str(),
                report_text::stage_table(client.stages(name).stages()).c_str());
  }
  switch (mark.state()) {
    case v1::Job::STATE_SUCCEEDED: return exit_ok;
    case v1::Job::STATE_CANCELLED: return exit_cancelled;
    default: return exit_failed;
  }
}

void add_watch(CLI::App& app, Common& common) {
  struct Options {
    std::string job = "latest";
    std::int64_t after = 0;
    double give_up_s = 0;
  };
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("watch", "follow a job live to its end");
  sub->add_option("JOB", o->job, "uid or latest");
  sub->add_option("--after", o->after, "begin after this sample")->check(CLI::NonNegativeNumber);
  sub->add_option("--give-up", o->give_up_s, "seconds without the server before giving up; 0: never");
  sub->callback([o, &common] {
    common.run = [o, &common](JobClient& c) { return follow(c, c.resolve(o->job), o->after, common.json, o->give_up_s); };
  });
}

}  // namespace seaway::client
