// SPDX-License-Identifier: GPL-3.0-or-later
// A YAML document as a plain tree with the place of every node. Made by a pass over parser events, so
// that limits hold while parsing and repeated keys, anchors and quoting stay visible.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/yaml.hpp"

namespace seaway::yaml {

struct Node {
  enum class Kind { null, scalar, list, map };
  struct Entry;
  Kind kind = Kind::null;
  Position at;
  std::string text;     ///< scalar
  bool quoted = false;  ///< scalar: written as a string on purpose
  std::vector<Node> items;
  std::vector<Entry> entries;  ///< in the order of the file, repeated keys included
};

struct Node::Entry {
  std::string key;
  Position at;
  Node value;
};

/// One document. Throws InputError for syntax, size, depth, anchors, aliases, tags, keys that are no plain
/// words, or more than one document.
Node parse(std::string_view text, const std::string& file);

}  // namespace seaway::yaml
