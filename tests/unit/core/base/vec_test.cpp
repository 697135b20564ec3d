#include "core/base/vec.hpp"

#include <gtest/gtest.h>

namespace seaway {
namespace {

TEST(Vec, SectionKeepsYAndZ) {
  EXPECT_EQ(from_vec3<2>(Vec3(1, 2, 3)), Vec2(2, 3));
  EXPECT_EQ(from_vec3<3>(Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

TEST(Vec, SectionPointsHaveZeroX) {
  EXPECT_EQ(to_vec3<2>(Vec2(2, 3)), Vec3(0, 2, 3));
  EXPECT_EQ(to_vec3<3>(Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

}  // namespace
}  // namespace seaway
