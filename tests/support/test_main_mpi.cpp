#include <gmock/gmock.h>

#include "core/mesh/parallel_runtime.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  const seaway::mesh::ParallelRuntime runtime;
  return RUN_ALL_TESTS();
}
