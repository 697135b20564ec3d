// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/workspace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temp_folder.hpp"

namespace seaway::jobs {
namespace {

using seaway::testing::TempFolder;
namespace fs = std::filesystem;

TEST(Workspace, KeepsFilesUnderTheirDigest) {
  TempFolder folder;
  const Workspace workspace(folder.path());
  const std::string path = workspace.keep_file("abc");
  EXPECT_EQ(fs::path(path).filename(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(workspace.keep_file("abc"), path);
  EXPECT_EQ(fs::file_size(path), 3u);
}

TEST(Workspace, SweepsFilesThatNobodyHasAskedForLately) {
  TempFolder folder;
  const Workspace workspace(folder.path());
  const std::string old = workspace.keep_file("old"), used = workspace.keep_file("used"), again = workspace.keep_file("again"),
                    fresh = workspace.keep_file("fresh"), part = folder / "files/0123.Ab12Cd";
  std::ofstream(part) << "a crash has left this";
  for (const std::string& file : {old, used, again, part}) fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(2));
  EXPECT_EQ(workspace.keep_file("again"), again);
  EXPECT_EQ(workspace.sweep_files(std::chrono::hours(1), {fs::path(used).filename().string()}), 2);
  for (const auto& [file, stays] : {std::pair{old, false}, {part, false}, {used, true}, {again, true}, {fresh, true}})
    EXPECT_EQ(fs::exists(file), stays) << file;
  EXPECT_EQ(workspace.keep_file("old"), old) << "and it comes again";
  EXPECT_EQ(fs::file_size(old), 3u);
}

TEST(Workspace, RemovesWhatTheStoreDoesNotKnow) {
  TempFolder folder;
  const Workspace workspace(folder.path());
  workspace.prepare_run("job", {}, {});
  const std::string run = workspace.run_folder("job");
  const auto write = [&](const std::string& name, const std::string& text) { std::ofstream(run + "/" + name) << text; };
  write("old.checkpoint", "1");
  write("new.checkpoint", "2");
  write("replaced.checkpoint", "3");
  write("section.json", "{}");
  write("torn.part", "");
  std::vector<store::Checkpoint> known{describe_checkpoint(run + "/old.checkpoint", 10),
                                       describe_checkpoint(run + "/replaced.checkpoint", 20)};
  write("other", "later");
  fs::rename(run + "/other", run + "/replaced.checkpoint");  // a newer one under the recorded name
  const auto removed = workspace.prepare_run("job", known, {{"section.json", run + "/section.json", "", 2, 0}});
  EXPECT_THAT(removed, ::testing::UnorderedElementsAre("new.checkpoint", "replaced.checkpoint", "torn.part"));
  EXPECT_TRUE(fs::exists(run + "/old.checkpoint"));
  EXPECT_TRUE(fs::exists(run + "/section.json"));
}

}  // namespace
}  // namespace seaway::jobs
