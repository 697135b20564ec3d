// p4est needs MPI. A process constructs one ParallelRuntime in main, before the first forest; no mpirun is
// needed. Signal handlers are best installed afterwards.
#pragma once

#include <mutex>

namespace seaway::mesh {

class ParallelRuntime {
 public:
  ParallelRuntime();
  ~ParallelRuntime();
  ParallelRuntime(const ParallelRuntime&) = delete;
  ParallelRuntime& operator=(const ParallelRuntime&) = delete;
};

/// p4est keeps global state: its calls stay under this lock.
std::mutex& p4est_lock();

}  // namespace seaway::mesh
