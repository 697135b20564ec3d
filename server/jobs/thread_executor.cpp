// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/executor.hpp"

namespace seaway::jobs {
namespace {

class ThreadExecutor final : public Executor {
 public:
  ThreadExecutor(RunSettings settings, Solver solver, const Workspace& workspace, store::JobStore& store,
                 std::shared_ptr<spdlog::logger> log)
      : settings_(settings), solver_(std::move(solver)), workspace_(workspace), store_(store), log_(std::move(log)) {}

  RunResult run(const store::Job& job, const AttemptControl& control) override {
    std::stop_source either;
    const std::stop_callback on_stop(control.stop, [&] { either.request_stop(); });
    const std::stop_callback on_kill(control.kill, [&] { either.request_stop(); });
    return run_job(job, solver_, workspace_, store_, settings_, either.get_token(), log_);
  }

 private:
  const RunSettings settings_;
  const Solver solver_;
  const Workspace& workspace_;
  store::JobStore& store_;
  const std::shared_ptr<spdlog::logger> log_;
};

}  // namespace

std::unique_ptr<Executor> make_thread_executor(RunSettings settings, Solver solver, const Workspace& workspace,
                                               store::JobStore& store, std::shared_ptr<spdlog::logger> log) {
  return std::make_unique<ThreadExecutor>(settings, std::move(solver), workspace, store, std::move(log));
}

}  // namespace seaway::jobs
