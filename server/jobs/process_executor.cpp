// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.hpp"
#include "server/jobs/core_slots.hpp"
#include "server/jobs/supervision.hpp"

namespace seaway::jobs {
namespace {

class ProcessExecutor final : public Executor {
 public:
  ProcessExecutor(ProcessSettings settings, const Workspace& workspace, store::JobStore& store,
                  std::shared_ptr<spdlog::logger> log)
      : settings_(std::move(settings)), workspace_(workspace), store_(store), log_(std::move(log)),
        slots_(available_cpus(), settings_.jobs, settings_.run.threads) {
    if (::access(settings_.program.c_str(), X_OK) != 0)
      fail(ErrorCode::invalid_argument, "workers.program {}: {}; name the seaway-run of this version, or choose "
           "executor: thread", settings_.program, std::strerror(errno));
    for (const std::string& lease : workspace_.leases()) {
      take_lease(lease);
      ::unlink(lease.c_str());
    }
  }

  RunResult run(const store::Job& job, const AttemptControl& control) override {
    RunResult out;
    const CoreSlots::Slot slot = slots_.take();
    try {
      out = Supervision(settings_, workspace_, store_, log_, job, slot.cpus()).run(control);
    } catch (const NotStarted& error) {
      out = {RunResult::End::fault, store::Reason::executor_lost, error.what(), true};
    } catch (const std::exception& error) {
      const auto reason = says_no_space(error.what()) ? store::Reason::disk_full : store::Reason::executor_lost;
      out = {RunResult::End::fault, reason, error.what(), says_no_resources(error.what())};
    }
    ::unlink(workspace_.lease_path(job.uid).c_str());
    return out;
  }

 private:
  const ProcessSettings settings_;
  const Workspace& workspace_;
  store::JobStore& store_;
  const std::shared_ptr<spdlog::logger> log_;
  CoreSlots slots_;
};

}  // namespace

std::unique_ptr<Executor> make_process_executor(ProcessSettings settings, const Workspace& workspace,
                                                store::JobStore& store, std::shared_ptr<spdlog::logger> log) {
  return std::make_unique<ProcessExecutor>(std::move(settings), workspace, store, std::move(log));
}

}  // namespace seaway::jobs
