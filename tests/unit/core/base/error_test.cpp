#include "core/base/error.hpp"

#include <gtest/gtest.h>

#include "core/base/version.hpp"

namespace seaway {
namespace {

TEST(Error, CarriesCodeAndFormattedMessage) {
  try {
    fail(ErrorCode::not_found, "job {} of {}", 17, "me");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::not_found);
    EXPECT_STREQ(e.what(), "job 17 of me");
  }
}

TEST(Error, CheckThrowsOnlyWhenTheConditionFails) {
  EXPECT_NO_THROW(SEAWAY_CHECK(1 + 1 == 2, "arithmetic"));
  try {
    SEAWAY_CHECK(false, "level {} exceeds {}", 9, 7);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::invalid_argument);
    EXPECT_STREQ(e.what(), "level 9 exceeds 7");
  }
}

TEST(Error, CheckIsOneStatement) {
  bool other = false;
  if (false)
    SEAWAY_CHECK(false, "never");
  else
    other = true;
  EXPECT_TRUE(other);
}

TEST(Error, EveryCodeHasItsName) {
  EXPECT_EQ(to_string(ErrorCode::invalid_argument), "invalid_argument");
  EXPECT_EQ(to_string(ErrorCode::not_found), "not_found");
  EXPECT_EQ(to_string(ErrorCode::failed_precondition), "failed_precondition");
  EXPECT_EQ(to_string(ErrorCode::unavailable), "unavailable");
  EXPECT_EQ(to_string(ErrorCode::resource_exhausted), "resource_exhausted");
  EXPECT_EQ(to_string(ErrorCode::data_loss), "data_loss");
  EXPECT_EQ(to_string(ErrorCode::diverged), "diverged");
  EXPECT_EQ(to_string(ErrorCode::internal), "internal");
}

TEST(Version, IsNotEmpty) { EXPECT_FALSE(code_version().empty()); }

}  // namespace
}  // namespace seaway
