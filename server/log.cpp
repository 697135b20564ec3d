// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/log.hpp"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <iterator>

namespace seaway::server {
namespace {

class EscapedMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    for (const char c : message.payload) {
      const auto code = static_cast<unsigned char>(c);
      if (c == '\n')
        fmt::format_to(std::back_inserter(out), "\\n");
      else if (code < 0x20 || code == 0x7f)
        fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned>(code));
      else
        out.push_back(c);
    }
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<EscapedMessage>(); }
};

}  // namespace

std::shared_ptr<spdlog::logger> make_log(const std::string& file, const std::string& level) {
  std::shared_ptr<spdlog::sinks::sink> sink;
  if (file.empty())
    sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  else
    sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file);
  auto log = std::make_shared<spdlog::logger>("seawayd", std::move(sink));
  auto lines = std::make_unique<spdlog::pattern_formatter>();
  lines->add_flag<EscapedMessage>('*').set_pattern("%Y-%m-%dT%H:%M:%S.%e%z level=%l %*");
  log->set_formatter(std::move(lines));
  log->set_level(spdlog::level::from_str(level));
  log->flush_on(spdlog::level::info);
  return log;
}

}  // namespace seaway::server
