// Each case of client/examples is one that seaway takes, and its title says of what size it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/sim/check_case.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(SEAWAY_EXAMPLES))
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, AreTakenAsTheyAre) {
  for (const sim::Diagnostic& d : sim::check_case(example_case(GetParam())).diagnostics)
    EXPECT_NE(d.severity, sim::Diagnostic::Severity::error) << d.field << ": " << d.message;
}

TEST_P(Examples, TellTheirSizeInTheTitle) {
  const std::string name = GetParam(), title = example_case(name).title;
  for (const std::string size : {"demo", "desk", "paper"}) {
    if (name.find("_" + size + ".") == std::string::npos) continue;
    EXPECT_NE(title.find("(" + size), std::string::npos) << title;
    EXPECT_EQ(title.find("not for numbers") != std::string::npos, size == "demo") << title;
  }
  EXPECT_EQ(title.find("intact") != std::string::npos, name.find("_intact_") != std::string::npos) << title;
}

INSTANTIATE_TEST_SUITE_P(All, Examples, testing::ValuesIn(examples()), [](const auto& example) {
  const std::string& name = example.param;
  return name.substr(0, name.find('.'));
});

}  // namespace
}  // namespace seaway::validation
