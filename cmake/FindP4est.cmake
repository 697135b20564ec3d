# p4est ships no CMake package. Defines P4est::P4est (with sc and MPI).
find_package(MPI COMPONENTS C QUIET)
find_path(P4EST_INCLUDE_DIR p4est.h)
find_library(P4EST_LIBRARY p4est)
find_library(SC_LIBRARY sc)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(P4est
  REQUIRED_VARS P4EST_LIBRARY SC_LIBRARY P4EST_INCLUDE_DIR MPI_C_FOUND
  REASON_FAILURE_MESSAGE "install the Debian packages libp4est-dev and libopenmpi-dev")
if(P4est_FOUND AND NOT TARGET P4est::P4est)
  add_library(P4est::P4est INTERFACE IMPORTED)
  target_include_directories(P4est::P4est SYSTEM INTERFACE ${P4EST_INCLUDE_DIR})
  # The deprecated C++ bindings of MPI would have to be linked as well.
  target_compile_definitions(P4est::P4est INTERFACE OMPI_SKIP_MPICXX=1 MPICH_SKIP_MPICXX=1)
  target_link_libraries(P4est::P4est INTERFACE ${P4EST_LIBRARY} ${SC_LIBRARY} MPI::MPI_C)
endif()
