# Build options and the flags that every target of the project gets.
option(SEAWAY_NATIVE "Compile for the processor of this machine (-march=native)" ON)
option(SEAWAY_ASSERT "Keep SEAWAY_ASSERT in optimised builds" OFF)
option(SEAWAY_WERROR "Treat warnings as errors" OFF)
option(SEAWAY_BUILD_TESTS "Build tests, seaway-validate and seaway-bench" ON)
option(SEAWAY_FUZZ "Build the fuzz targets and nothing else (preset fuzz; needs clang)" OFF)
set(SEAWAY_SANITIZE "" CACHE STRING "Sanitizers, for example address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(SEAWAY_CCACHE ccache)
if(SEAWAY_CCACHE)
  # Paths relative to the source folder: several checkouts share one cache.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros ${SEAWAY_CCACHE})  # what it needs for precompiled headers
endif()

add_library(seaway_flags INTERFACE)
target_include_directories(seaway_flags INTERFACE ${PROJECT_SOURCE_DIR})
# Eigen's matrix products stay on their thread: blocking, and with it the last digit, would depend on the number of threads.
target_compile_definitions(seaway_flags INTERFACE EIGEN_DONT_PARALLELIZE)
target_compile_options(seaway_flags INTERFACE -pthread -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns about its own headers: AVX-512 (bug 105593), std::string (105651), std::optional and std::regex.
  target_compile_options(seaway_flags INTERFACE -Wno-uninitialized -Wno-maybe-uninitialized -Wno-restrict)
endif()
# -fno-math-errno and -fno-trapping-math let loops vectorise and change no result; NaN stays visible.
target_compile_options(seaway_flags INTERFACE $<$<CONFIG:Release>:-O3> -fno-math-errno -fno-trapping-math)
# No contraction: the same source gives the same bits whatever gets inlined where.
target_compile_options(seaway_flags INTERFACE -ffp-contract=off)
if(SEAWAY_NATIVE)
  target_compile_options(seaway_flags INTERFACE -march=native)
endif()
if(SEAWAY_WERROR)
  target_compile_options(seaway_flags INTERFACE -Werror)
endif()
if(SEAWAY_ASSERT OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  target_compile_definitions(seaway_flags INTERFACE SEAWAY_ENABLE_ASSERT=1)
endif()
# Sanitizers make programs slower. The time limits of all tests are multiplied by this factor, and tests that repeat
# themselves over many seeds take so many times fewer of them.
set(SEAWAY_SLOWDOWN 1)
if(SEAWAY_SANITIZE MATCHES address)
  set(SEAWAY_SLOWDOWN 5)
elseif(SEAWAY_SANITIZE MATCHES thread)
  set(SEAWAY_SLOWDOWN 20)
endif()
if(SEAWAY_SANITIZE)
  # The test preset asan sets ASAN_OPTIONS=intercept_tls_get_addr=0: LeakSanitizer of GCC 12 takes the word before a plugin's
  # thread-local block for its size and crashes on some of Open MPI's. Blocks of our own programs are found without it.
  # Undefined behaviour ends the program: a test that only prints it would pass.
  # -O1 and line tables alone: half the time to compile, and nearly the same to run.
  target_compile_options(seaway_flags INTERFACE -O1 -g1 -fsanitize=${SEAWAY_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(seaway_flags INTERFACE -fsanitize=${SEAWAY_SANITIZE})
endif()
