// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/plot/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/job_client.hpp"

extern char** environ;

namespace seaway::client {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string path = (fs::temp_directory_path() / "seaway-plot-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr) throw ClientError(exit_failed, "no temporary folder can be made");
    path_ = path;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void run_gnuplot(const std::string& script, const std::map<std::string, std::string>& data) {
  const Folder folder;
  for (const auto& [name, content] : data) std::ofstream(folder.path() / name, std::ios::binary) << content;
  const std::string script_path = (folder.path() / "script.gp").string();
  const std::string errors = (folder.path() / "errors.txt").string();
  std::ofstream(script_path) << "cd '" << folder.path().string() << "'\n" << script;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT, 0600);
  std::string program = "gnuplot";
  std::string argument = script_path;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t pid = 0;
  const int failed = ::posix_spawnp(&pid, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw ClientError(exit_failed, "gnuplot is not on PATH; install it (Debian: gnuplot-nox) and plot again");
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw ClientError(exit_failed, "gnuplot is not on PATH; install it (Debian: gnuplot-nox) and plot again");
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::stringstream text;
  text << std::ifstream(errors).rdbuf();
  throw ClientError(exit_failed, "gnuplot failed: " + text.str().substr(0, 500));
}

}  // namespace seaway::client
