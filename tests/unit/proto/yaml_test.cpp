// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/yaml.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "seaway/v1/case.pb.h"
#include "seaway/v1/server_config.pb.h"

namespace seaway::yaml {
namespace {

using ::testing::HasSubstr;

/// The only complaint about the text.
Problem refused(const std::string& text) {
  v1::Case message;
  try {
    read(text, "case.yaml", message);
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1u) << error.what();
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

TEST(Yaml, ReadsNestedMessagesListsAndEnumerators) {
  v1::Case m;
  const SourceMap lines = read(
      "title: \"A: b\"\n"
      "dimension: 2\n"
      "tank:\n"
      "  y_m: [-1, 2.5]\n"
      "wave:\n"
      "  regular: {height_m: 6.1e-2, theory: airy}\n"
      "body:\n"
      "  free: [heave, roll]\n"
      "cascade:\n"
      "  stages:\n"
      "    - name: a\n"
      "    - name: b\n"
      "      mesh: {hull_cell_m: +0.01}\n",
      "case.yaml", m);
  EXPECT_EQ(m.title(), "A: b");
  EXPECT_EQ(m.tank().y_m(1), 2.5);
  EXPECT_EQ(m.wave().regular().height_m(), 0.061);
  EXPECT_EQ(m.wave().regular().theory(), v1::RegularWave::THEORY_AIRY);
  EXPECT_EQ(m.body().free(1), v1::DOF_ROLL);
  EXPECT_EQ(m.cascade().stages(1).mesh().hull_cell_m(), 0.01);
  EXPECT_EQ(lines.find("wave.regular.height_m").line, 6);
  EXPECT_EQ(lines.find("cascade.stages[1].mesh.hull_cell_m").line, 13);
}

TEST(Yaml, FindsTheNearestLineOfAMissingField) {
  v1::Case m;
  const SourceMap lines = read("title: x\ntank:\n  y_m: [0, 1]\n", "case.yaml", m);
  EXPECT_EQ(lines.find("tank.z_m").line, 2);
  EXPECT_EQ(lines.find("tank.y_m[1]").line, 3);
  EXPECT_EQ(lines.find("body").line, 0);
}

TEST(Yaml, RoundTripsThroughText) {
  v1::Case m, again;
  m.set_title("quote \" backslash \\ and\nline");
  m.set_dimension(2);
  m.mutable_wave()->mutable_calm();
  m.mutable_tank()->add_y_m(-0.1);
  m.mutable_tank()->add_y_m(1.0 / 3.0);
  m.mutable_body()->add_free(v1::DOF_HEAVE);
  m.mutable_body()->set_mass_kg_per_m(15);
  m.mutable_cascade()->add_stages()->mutable_end()->mutable_converged()->set_tolerance(1e-3);
  m.mutable_cascade()->add_stages();
  m.mutable_hull()->mutable_polygon()->add_vertices()->set_y_m(1e-300);
  read(write(m), "again.yaml", again);
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(m, again)) << write(m);
}

TEST(Yaml, NamesTheNearestKeyOfAnUnknownOne) {
  const Problem p = refused("title: x\ntanc: {}\n");
  EXPECT_EQ(p.at.line, 2);
  EXPECT_EQ(p.field, "tanc");
  EXPECT_THAT(p.hint, HasSubstr("did you mean tank?"));
}

TEST(Yaml, NamesTheUnitOfAKeyWithAnother) {
  EXPECT_THAT(refused("wave:\n  regular: {height_mm: 61}\n").hint, HasSubstr("write height_m, in metres"));
  EXPECT_THAT(refused("wave:\n  regular: {heading_rad: 1}\n").hint, HasSubstr("write heading_deg, in degrees"));
  EXPECT_THAT(refused("body: {draft: 1}\n").hint, HasSubstr("write draft_m, in metres"));
}

TEST(Yaml, RefusesAUnitBehindANumber) {
  const Problem p = refused("wave:\n  regular: {height_m: 61 mm}\n");
  EXPECT_THAT(p.message, HasSubstr("a number in metres, got '61 mm'"));
  EXPECT_THAT(p.hint, HasSubstr("in metres"));
}

TEST(Yaml, RefusesRepeatedKeys) {
  const Problem p = refused("title: a\ndimension: 2\ntitle: b\n");
  EXPECT_EQ(p.at.line, 3);
  EXPECT_THAT(p.message, HasSubstr("twice"));
}

TEST(Yaml, RefusesTwoMembersOfAOneof) {
  const Problem p = refused("wave:\n  calm: {}\n  regular: {height_m: 1}\n");
  EXPECT_EQ(p.field, "wave.regular");
  EXPECT_THAT(p.hint, HasSubstr("calm, regular"));
}

class RefusedText : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};
TEST_P(RefusedText, SaysWhy) {
  const Problem p = refused(GetParam().first);
  EXPECT_THAT(p.message + "; " + p.hint, HasSubstr(GetParam().second));
  EXPECT_GT(p.at.line, 0);
}
INSTANTIATE_TEST_SUITE_P(
    Yaml, RefusedText,
    ::testing::Values(std::pair{"dimension: two\n", "a whole number, got 'two'"},
                      std::pair{"dimension: 2.5\n", "a whole number"}, std::pair{"dimension: \"2\"\n", "a whole number"},
                      std::pair{"dimension: 99999999999\n", "too large"},
                      std::pair{"dimension: [2]\n", "got a list"}, std::pair{"dimension:\n", "got nothing"},
                      std::pair{"mesh: {base_cell_m: .nan}\n", "must be finite"},
                      std::pair{"mesh: {base_cell_m: -.inf}\n", "must be finite"},
                      std::pair{"mesh: {base_cell_m: nan}\n", "must be finite"},
                      std::pair{"mesh: {base_cell_m: 1e999}\n", "must be finite"},
                      std::pair{"mesh: 3\n", "expected keys and values, got '3'"},
                      std::pair{"tank: {y_m: 3}\n", "expected a list"},
                      std::pair{"tank: {open_top: yes}\n", "true or false"},
                      std::pair{"body: {free: [rol]}\n", "did you mean roll?"},
                      std::pair{"title: &a x\n", "anchors"}, std::pair{"title: *a\n", "not valid YAML"},
                      std::pair{"title: !!str x\n", "tags"}, std::pair{"? [a, b]\n: c\n", "plain word"},
                      std::pair{"title: x\n---\ntitle: y\n", "second document"},
                      std::pair{"title: [x\n", "not valid YAML"}, std::pair{"- a\n- b\n", "got a list"}));

TEST(Yaml, RefusesAliases) {
  v1::Case m;
  EXPECT_THROW(read("a: &x [1]\nb: [*x, *x, *x]\n", "bomb.yaml", m), InputError);
}

TEST(Yaml, RefusesDeepNestingAndLargeFiles) {
  v1::Case m;
  EXPECT_THROW(read("title: " + std::string(100000, '[') + "\n", "deep.yaml", m), InputError);
  EXPECT_THROW(read("title: " + std::string(max_bytes, 'x') + "\n", "large.yaml", m), InputError);
  EXPECT_THROW(read(std::string("title: a\0b\n", 11), "zero.yaml", m), InputError);
}

TEST(Yaml, ReportsAllMistakesTogether) {
  v1::Case m;
  try {
    read("titel: x\ndimension: two\nmesh: {base_cell_cm: 8}\n", "case.yaml", m);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 3u);
    EXPECT_THAT(error.what(), HasSubstr("case.yaml:2:12: dimension: expected a whole number, got 'two'"));
  }
}

TEST(Yaml, ReadsTheExampleCases) {
  v1::Case m;
  EXPECT_NO_THROW(read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", m));
}

TEST(Yaml, ReadsTheSampleConfiguration) {
  v1::ServerConfig m;
  EXPECT_NO_THROW(read_file(SEAWAY_SOURCE_DIR "/deploy/seawayd.yaml", m));
}

TEST(Yaml, SaysThatAFileIsMissing) {
  v1::Case m;
  EXPECT_THROW(read_file("/does/not/exist.yaml", m), InputError);
}

}  // namespace
}  // namespace seaway::yaml
