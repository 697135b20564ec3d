// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <utility>

extern char** environ;

namespace seaway::testing {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds poll{2};

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

Process::Process(std::vector<std::string> command, const std::string& output, std::vector<std::string> environment) {
  std::vector<char*> arguments, variables;
  for (auto& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  for (auto& variable : environment) variables.push_back(variable.data());
  for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
  variables.push_back(nullptr);
  const std::string file = output.empty() ? "/dev/null" : output;
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ > 0) return;
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  ::dup2(fd, STDOUT_FILENO);
  ::dup2(fd, STDERR_FILENO);
  ::execvpe(arguments[0], arguments.data(), variables.data());
  ::_exit(127);
}

Process::~Process() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  wait();
}

Process& Process::operator=(Process&& other) noexcept {
  std::swap(pid_, other.pid_);
  return *this;
}

void Process::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

int Process::wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  return code_of(status);
}

int Process::wait_for(std::chrono::milliseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  for (;;) {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = 0;
      return code_of(status);
    }
    if (std::chrono::steady_clock::now() > deadline) return -1;
    std::this_thread::sleep_for(poll);
  }
}

std::size_t Process::resident_bytes() const {
  std::ifstream in("/proc/" + std::to_string(pid_) + "/statm");
  std::size_t total = 0, resident = 0;
  in >> total >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

Finished run_program(std::vector<std::string> command, std::vector<std::string> environment) {
  std::string file = (fs::temp_directory_path() / "seaway-output-XXXXXX").string();
  ::close(::mkstemp(file.data()));
  Process process(std::move(command), file, std::move(environment));
  Finished out;
  out.code = process.wait();
  out.output = read_text(file);
  fs::remove(file);
  return out;
}

Daemon::Daemon(std::string program, std::string folder, std::vector<std::string> environment,
               std::vector<std::string> arguments)
    : program_(std::move(program)), folder_(std::move(folder)), environment_(std::move(environment)),
      arguments_(std::move(arguments)) {}

void Daemon::start() {
  const std::string file = folder_ + "/address";
  fs::remove(file);
  const std::string port = address_.empty() ? "0" : address_.substr(address_.rfind(':') + 1);
  std::vector<std::string> command{program_, "--data-dir", folder_ + "/data", "--port", port, "--address-file", file};
  command.insert(command.end(), arguments_.begin(), arguments_.end());
  process_.clear();
  process_.emplace_back(std::move(command), folder_ + "/log.txt", environment_);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!fs::exists(file)) {
    if (process_.front().wait_for(poll) >= 0 || std::chrono::steady_clock::now() > deadline)
      throw std::runtime_error("seawayd did not start:\n" + read_text(folder_ + "/log.txt"));
  }
  address_ = read_text(file);
  address_.erase(address_.find_last_not_of('\n') + 1);
}

void Daemon::kill() {
  process_.front().signal(SIGKILL);
  process_.front().wait();
  process_.clear();
}

int Daemon::terminate() {
  process_.front().signal(SIGTERM);
  const int code = process_.front().wait_for(std::chrono::seconds(20));
  process_.clear();
  return code;
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace seaway::testing
