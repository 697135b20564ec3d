// SPDX-License-Identifier: GPL-3.0-or-later
// YAML text <-> any message of the schema, strictly. The keys are the field names, the nesting is the
// message's own; enumerators are written in lower case without the prefix of their type
// (THEORY_AIRY -> airy), lists of numbers as [a, b], a message of a oneof as its only key.
//
// Refused, each with line and column: unknown and repeated keys (with the nearest known one, or the unit
// that the schema wants), wrong types, numbers with a unit behind them, NaN and infinity, integers that do
// not fit, two members of one oneof, anchors, aliases and tags, more than 1 MiB, more than 32 levels.
// All mistakes of a file are reported together, except that a syntax error ends the reading.
//
// Pure functions; safe from any thread.
#pragma once

#include <google/protobuf/message.h>

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace seaway::yaml {

inline constexpr std::size_t max_bytes = 1 << 20;
inline constexpr int max_depth = 32;

/// From 1; line 0: not known.
struct Position {
  int line = 0;
  int column = 0;
};

struct Problem {
  Position at;
  std::string field;    ///< path, for example hull.compartments[1].wall_thickness_m; may be empty
  std::string message;  ///< the value, and what is allowed
  std::string hint;     ///< what to do; may be empty
};

/// `file:line:column: field: message; hint` with the parts that are known.
std::string to_text(const std::string& file, const Problem& problem);

/// A file that cannot be accepted. what() holds one line a problem.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Where each field stands in the file, so that what is found later (hydrostatics, mesh) can be said with
/// its line.
class SourceMap {
 public:
  SourceMap() = default;
  explicit SourceMap(std::string file) : file_(std::move(file)) {}
  void add(const std::string& field, Position at) { positions_.emplace(field, at); }
  /// Of the field, else of the nearest message around it that is in the file, else line 0.
  Position find(std::string field) const;
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::map<std::string, Position> positions_;
};

/// Reads `text` into `message`, which should be empty. `file` is only used in messages.
/// Throws InputError; `message` is then unspecified.
SourceMap read(std::string_view text, const std::string& file, google::protobuf::Message& message);

/// The same from a file; one that cannot be read is an InputError too.
SourceMap read_file(const std::string& path, google::protobuf::Message& message);

/// Text that read() turns into an equal message. Fields that are not set are left out.
std::string write(const google::protobuf::Message& message);

}  // namespace seaway::yaml
