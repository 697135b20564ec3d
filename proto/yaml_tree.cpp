// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <istream>
#include <streambuf>

namespace seaway::yaml {
namespace {

Position position(const YAML::Mark& mark) { return {mark.line + 1, mark.column + 1}; }

struct Refused {
  Problem problem;
};

[[noreturn]] void refuse(const YAML::Mark& mark, std::string message, std::string hint) {
  throw Refused{{position(mark), "", std::move(message), std::move(hint)}};
}

class TreeBuilder final : public YAML::EventHandler {
 public:
  Node take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) refuse(mark, "a second document", "keep one document per file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    no_anchor(mark, anchor);
    Node node;
    node.at = position(mark);
    place(mark, std::move(node));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "aliases (*name) are not accepted", "write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    no_anchor(mark, anchor);
    no_tag(mark, tag);
    Node node;
    node.kind = Node::Kind::scalar;
    node.at = position(mark);
    node.text = value;
    node.quoted = tag == "!";
    if (!node.quoted && (value == "~" || value == "null")) node.kind = Node::Kind::null;
    place(mark, std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    YAML::Mark mark;
    Node node;
    bool has_key = false;
    std::string key;
    Position key_at;
  };

  static void no_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) refuse(mark, "anchors (&name) are not accepted", "write the value out");
  }
  static void no_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!")
      refuse(mark, "tags (" + tag + ") are not accepted", "remove the tag");
  }
  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    no_anchor(mark, anchor);
    no_tag(mark, tag);
    if (static_cast<int>(levels_.size()) >= max_depth)
      refuse(mark, "more than " + std::to_string(max_depth) + " levels of nesting", "flatten the file");
    if (!levels_.empty() && levels_.back().node.kind == Node::Kind::map && !levels_.back().has_key)
      refuse(mark, "a key must be a plain word", "");
    Level level;
    level.mark = mark;
    level.node.kind = kind;
    level.node.at = position(mark);
    levels_.push_back(std::move(level));
  }
  void close() {
    Level done = std::move(levels_.back());
    levels_.pop_back();
    place(done.mark, std::move(done.node));
  }
  void place(const YAML::Mark& mark, Node node) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = levels_.back();
    if (level.node.kind == Node::Kind::list) {
      level.node.items.push_back(std::move(node));
    } else if (!level.has_key) {
      if (node.kind != Node::Kind::scalar) refuse(mark, "a key must be a plain word", "");
      level.has_key = true;
      level.key = node.text;
      level.key_at = node.at;
    } else {
      level.has_key = false;
      level.node.entries.push_back({std::move(level.key), level.key_at, std::move(node)});
    }
  }

  int documents_ = 0;
  Node root_;
  std::vector<Level> levels_;
};

/// A stream over memory that copies nothing.
struct ViewBuffer : std::streambuf {
  explicit ViewBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());  // the buffer is only read
    setg(begin, begin, begin + text.size());
  }
};

}  // namespace

Node parse(std::string_view text, const std::string& file) {
  if (text.size() > max_bytes)
    throw InputError(file, {{{1, 1}, "", std::to_string(text.size()) + " bytes; allowed are 1048576",
                             "put large tables in files of their own"}});
  if (const auto nul = text.find('\0'); nul != std::string_view::npos)
    throw InputError(file, {{{}, "", "a zero byte at offset " + std::to_string(nul), "save the file as UTF-8 text"}});
  try {
    ViewBuffer buffer(text);
    std::istream stream(&buffer);
    YAML::Parser parser(stream);
    TreeBuilder builder;
    if (!parser.HandleNextDocument(builder)) return {};
    Node root = builder.take();
    parser.HandleNextDocument(builder);  // refuses a second one
    return root;
  } catch (const Refused& refused) {
    throw InputError(file, {refused.problem});
  } catch (const YAML::Exception& error) {
    const Position at = error.mark.is_null() ? Position{} : position(error.mark);
    throw InputError(file, {{at, "", "not valid YAML: " + error.msg, "check indentation, colons and brackets"}});
  }
}

}  // namespace seaway::yaml
