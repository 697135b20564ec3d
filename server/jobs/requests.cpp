// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/requests.hpp"

#include <algorithm>

#include "server/convert/input_error.hpp"

namespace seaway::jobs {
namespace {

bool is_label_key(const std::string& key) {
  return !key.empty() && key.size() <= 63 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
  });
}

}  // namespace

[[noreturn]] void refuse(const std::string& reason, const std::string& field, const std::string& message,
                         const std::string& hint) {
  throw convert::InputError(reason, {{sim::Diagnostic::Severity::error, field, message, hint}});
}

bool is_text(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

bool is_uuid(const std::string& text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    const char c = text[i];
    const bool hex = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    if (dash ? c != '-' : !hex) return false;
  }
  return true;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

void check_labels(const std::string& field, const store::Labels& labels) {
  if (labels.size() > 64) refuse("INVALID_REQUEST", field, std::to_string(labels.size()) + " labels", "at most 64");
  for (const auto& [key, value] : labels) {
    if (!is_label_key(key)) refuse("INVALID_REQUEST", field, "a key is malformed", "1 to 63 of a-z, 0-9, dot, _ and -");
    if (value.size() > 255 || !is_text(value)) refuse("INVALID_REQUEST", field + "." + key, "is too long or no text", "at most 255 bytes of text in one line");
  }
}

void check_traits(const std::string& path, int priority, const store::Labels& labels, const std::string& note) {
  if (priority < -100 || priority > 100) refuse("INVALID_REQUEST", path + "priority", std::to_string(priority) + " is not allowed", "must be -100 to 100");
  check_labels(path + "labels", labels);
  if (note.size() > 4000) refuse("INVALID_REQUEST", path + "note", std::to_string(note.size()) + " bytes", "at most 4000");
  std::string lines = note;
  std::erase_if(lines, [](char c) { return c == '\n' || c == '\t'; });
  if (!is_text(lines)) refuse("INVALID_REQUEST", path + "note", "has control characters", "write plain text");
}

}  // namespace seaway::jobs
