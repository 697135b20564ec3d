# Headers of other projects that the solver and its tests include, compiled once: a file takes half the time. For the
# service it was tried with those of gRPC and protobuf and cost more than it saved: they are large, and few files use them all.
# A folder says SEAWAY_PRECOMPILED_HEADERS for itself and the folders below it. Every file still includes what it uses:
# preset dev builds without.
# GCC compiles a file with the level of optimisation of these headers and says nothing if the file's own is another (-O3
# became -O2 so, and the solver took 1.7 times as long): a file with a level of its own has to do without.
find_package(Eigen3 REQUIRED)
find_package(fmt REQUIRED)

set(headers <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <filesystem> <fstream> <functional> <limits> <map>
            <memory> <mutex> <numeric> <optional> <random> <set> <span> <sstream> <string> <thread> <variant> <vector>
            <fmt/format.h> <Eigen/Dense>)
add_library(seaway_headers OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled_headers.cpp)
target_link_libraries(seaway_headers PRIVATE seaway_flags fmt::fmt Eigen3::Eigen)
target_precompile_headers(seaway_headers PRIVATE ${headers})
if(SEAWAY_BUILD_TESTS)
  find_package(GTest REQUIRED)
  add_library(seaway_headers_test OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled_headers.cpp)
  target_link_libraries(seaway_headers_test PRIVATE seaway_flags fmt::fmt Eigen3::Eigen GTest::gmock)
  target_precompile_headers(seaway_headers_test PRIVATE ${headers} <gmock/gmock.h> <gtest/gtest.h>)
endif()
