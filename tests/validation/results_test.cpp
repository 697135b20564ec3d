#include "tests/validation/results.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace seaway::validation {
namespace {

class JsonLines {
 public:
  JsonLines() : file_(std::tmpfile()) {}
  ~JsonLines() { std::fclose(file_); }
  std::FILE* file() const { return file_; }
  std::vector<nlohmann::ordered_json> read() const {
    std::rewind(file_);
    std::vector<nlohmann::ordered_json> lines;
    char buffer[4096];
    while (std::fgets(buffer, sizeof buffer, file_))
      lines.push_back(nlohmann::ordered_json::parse(buffer));
    return lines;
  }

 private:
  std::FILE* file_;
};

TEST(ValidationResults, LinesHaveExactlyTheAgreedKeys) {
  JsonLines out;
  Results results("some_case", Format::json, out.file());
  results.expect_near("period", 0.93, "s", 0.94, 0.02);
  const auto line = out.read().at(0);
  std::string keys;
  for (const auto& item : line.items()) keys.append(item.key()).append(1, ' ');
  EXPECT_EQ(keys, "case quantity value unit reference tolerance pass cpu_s ");
  EXPECT_EQ(line["case"], "some_case");
  EXPECT_EQ(line["quantity"], "period");
  EXPECT_EQ(line["value"], 0.93);
  EXPECT_EQ(line["unit"], "s");
  EXPECT_EQ(line["reference"], 0.94);
  EXPECT_EQ(line["tolerance"], 0.02);
  EXPECT_EQ(line["pass"], true);
}

TEST(ValidationResults, BoundsAreInclusiveAndFailuresAreCounted) {
  JsonLines out;
  Results results("c", Format::json, out.file());
  results.expect_below("a", 2, "1", 2);
  results.expect_above("b", 2, "1", 2);
  results.expect_near("c", -1, "1", 0, 1);
  EXPECT_EQ(results.failures(), 0);
  results.expect_below("d", 2.1, "1", 2);
  results.expect_above("e", 1.9, "1", 2);
  results.expect_near("f", 1.1, "1", 0, 1);
  EXPECT_EQ(results.failures(), 3);
  EXPECT_EQ(results.lines(), 6);
  EXPECT_TRUE(out.read().at(0)["reference"].is_null());
  EXPECT_TRUE(out.read().at(1)["tolerance"].is_null());
}

TEST(ValidationResults, WhatIsNotANumberFails) {
  JsonLines out;
  Results results("c", Format::json, out.file());
  results.expect_below("a", std::nan(""), "1", 1);
  results.expect_above("b", std::nan(""), "1", 1);
  results.expect_near("c", std::nan(""), "1", 0, 1);
  results.report("d", std::nan(""), "1");
  results.fail("on purpose");
  EXPECT_EQ(results.failures(), 5);
  for (const auto& line : out.read()) {
    EXPECT_TRUE(line["value"].is_null());
    EXPECT_EQ(line["pass"], false);
  }
}

}  // namespace
}  // namespace seaway::validation
