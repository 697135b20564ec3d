# Headers of other projects, compiled once: most of the time to compile a file of ours went into them. A folder names
# its set in SEAWAY_PRECOMPILED_HEADERS, for itself and the folders below it; its tests take SET_test, with GoogleTest.
# Every file still includes what it uses: preset dev builds without them.
# GCC compiles a file with the optimisation of its set and says nothing if the file's own options are others (-O3 became
# -O2 so, and the solver took 1.7 times as long): a target with options of its own has to do without.
find_package(Eigen3 REQUIRED)
find_package(fmt REQUIRED)
find_package(Protobuf REQUIRED)
find_package(gRPC CONFIG REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

set(standard_headers <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <filesystem> <fstream> <functional>
                     <limits> <map> <memory> <mutex> <numeric> <optional> <random> <set> <span> <sstream> <string> <thread>
                     <variant> <vector> <fmt/format.h>)
set(common_headers ${standard_headers} <Eigen/Dense>)
set(service_headers ${standard_headers} <google/protobuf/message.h> <google/protobuf/map.h> <google/protobuf/repeated_field.h>
                    <google/protobuf/generated_message_util.h> <grpcpp/grpcpp.h> <CLI/CLI.hpp> <nlohmann/json.hpp>)

# seaway_precompiled_headers(SET header... DEPENDS library...)
function(seaway_precompiled_headers set)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  add_library(seaway_headers_${set} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled_headers.cpp)
  target_link_libraries(seaway_headers_${set} PRIVATE seaway_flags fmt::fmt ${ARG_DEPENDS})
  target_precompile_headers(seaway_headers_${set} PRIVATE ${ARG_UNPARSED_ARGUMENTS})
endfunction()

set(service_libraries protobuf::libprotobuf gRPC::grpc++ CLI11::CLI11 nlohmann_json::nlohmann_json)
seaway_precompiled_headers(common ${common_headers} DEPENDS Eigen3::Eigen)
seaway_precompiled_headers(service ${service_headers} DEPENDS ${service_libraries})
if(SEAWAY_BUILD_TESTS)
  find_package(GTest REQUIRED)
  seaway_precompiled_headers(common_test ${common_headers} <gmock/gmock.h> <gtest/gtest.h> DEPENDS Eigen3::Eigen GTest::gmock)
  seaway_precompiled_headers(service_test ${service_headers} <gmock/gmock.h> <gtest/gtest.h>
                             DEPENDS ${service_libraries} GTest::gmock)
endif()
