// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "core/base/error.hpp"

extern char** environ;

namespace seaway::server {

namespace fs = std::filesystem;

void run_gnuplot(const fs::path& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const std::string errors = (folder / "gnuplot.log").string();
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::string program = "gnuplot", argument = (folder / script).string();
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t pid = 0;
  const int failed = ::posix_spawnp(&pid, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 127 << 8;
  while (failed == 0 && ::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (failed != 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
    fail(ErrorCode::failed_precondition, "gnuplot is not on PATH; install it (Debian: gnuplot-nox) or leave --out");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail(ErrorCode::failed_precondition, "gnuplot failed; see {}", errors);
  fs::remove(errors);
}

void draw_figure(const fs::path& folder, const std::string& name, const Figure& figure) {
  fs::create_directories(folder);
  for (const auto& [file, content] : figure.data) std::ofstream(folder / (name + "_" + file), std::ios::binary) << content;
  std::string script = figure.script;
  for (const auto& [file, content] : figure.data) {
    const std::string from = "'" + file + "'", to = "'" + name + "_" + file + "'";
    for (std::size_t at = 0; (at = script.find(from, at)) != script.npos; at += to.size()) script.replace(at, from.size(), to);
  }
  std::ofstream(folder / (name + ".gp")) << "cd '" << fs::absolute(folder).string() << "'\n" << script;
  run_gnuplot(folder, name + ".gp");
}

}  // namespace seaway::server
