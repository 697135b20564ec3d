#include "core/mesh/parallel_runtime.hpp"

#include <mpi.h>
#include <p4est.h>

#include <cstdlib>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace seaway::mesh {
namespace {

/// What the calling thread allocates while this lives is no leak to the address sanitizer. Open MPI leaks some kB at start and
/// end, in plugins that are unloaded when leaks are looked for: a list of suppressions would find no name to match.
struct LeaksAllowed {
#ifdef __SANITIZE_ADDRESS__
  const __lsan::ScopedDisabler disabler;
#else
  LeaksAllowed() {}  // not trivial: an object for its life alone is no unused variable
#endif
};

}  // namespace

ParallelRuntime::ParallelRuntime() {
  // A single process: keep MPI off the network and away from shared-memory files.
  setenv("OMPI_MCA_btl", "self", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_osc", "^ucx", 0);
  // Without this each process starts a daemon of Open MPI beside it, which also has to be installed.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  setenv("OMPI_MCA_orte_base_help_aggregate", "0", 0);
  int provided = 0;
  const LeaksAllowed in_open_mpi;  // sc_init has it make a key that nobody frees
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  sc_init(sc_MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_ERROR);
  p4est_init(nullptr, SC_LP_ERROR);
}

ParallelRuntime::~ParallelRuntime() {
  sc_finalize();
  const LeaksAllowed in_open_mpi;
  MPI_Finalize();
}

std::mutex& p4est_lock() {
  static std::mutex lock;
  return lock;
}

}  // namespace seaway::mesh
