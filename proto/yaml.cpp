// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/yaml.hpp"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "proto/yaml_keys.hpp"
#include "proto/yaml_tree.hpp"

namespace seaway::yaml {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

std::string upper_snake(std::string_view camel) {
  std::string out;
  for (const char c : camel) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper && !out.empty()) out += '_';
    out += upper ? c : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  }
  return out;
}

/// THEORY_STREAM_FUNCTION of Theory -> stream_function.
std::string short_name(const EnumValueDescriptor& value) {
  std::string name = value.name();
  const std::string prefix = upper_snake(value.type()->name()) + "_";
  if (name.starts_with(prefix)) name.erase(0, prefix.size());
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  return name;
}

std::string what_is(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null: return "nothing";
    case Node::Kind::list: return "a list";
    case Node::Kind::map: return "a mapping";
    case Node::Kind::scalar: break;
  }
  return "'" + (node.text.size() > 60 ? node.text.substr(0, 60) + "..." : node.text) + "'";
}

class Reader {
 public:
  Reader(std::string file) : map_(std::move(file)) {}

  void read_message(const Node& node, const std::string& path, Message& message) {
    const Descriptor& type = *message.GetDescriptor();
    if (node.kind == Node::Kind::null && type.field_count() == 0) return;
    if (node.kind != Node::Kind::map) {
      problem(node.at, path, "expected keys and values, got " + what_is(node),
              "allowed keys are " + list(keys(type)));
      return;
    }
    std::set<std::string> seen;
    for (const Node::Entry& entry : node.entries) {
      const std::string field_path = path.empty() ? entry.key : path + "." + entry.key;
      const FieldDescriptor* field = type.FindFieldByName(entry.key);
      if (field == nullptr) {
        problem(entry.at, field_path, "unknown key", advise_key(entry.key, keys(type)));
        continue;
      }
      if (!seen.insert(entry.key).second) {
        problem(entry.at, field_path, "the key is given twice", "keep one of them");
        continue;
      }
      map_.add(field_path, entry.at);
      if (const auto* group = field->real_containing_oneof()) {
        if (const auto* other = message.GetReflection()->GetOneofFieldDescriptor(message, group)) {
          problem(entry.at, field_path, "cannot stand beside " + other->name(),
                  "give exactly one of " + list(keys(*group)));
          continue;
        }
      }
      if (field->is_repeated())
        read_list(entry.value, field_path, message, *field);
      else
        read_value(entry.value, field_path, message, *field);
    }
  }

  SourceMap finish() {
    if (!problems_.empty()) throw InputError(map_.file(), std::move(problems_));
    return std::move(map_);
  }

 private:
  template <class Group>
  static std::vector<std::string> keys(const Group& group) {
    std::vector<std::string> out;
    for (int i = 0; i < group.field_count(); ++i) out.push_back(group.field(i)->name());
    return out;
  }
  static std::string list(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
    return out.empty() ? "none" : out;
  }
  void problem(Position at, const std::string& path, std::string message, std::string hint) {
    if (problems_.size() < 100) problems_.push_back({at, path, std::move(message), std::move(hint)});
  }

  void read_list(const Node& node, const std::string& path, Message& message, const FieldDescriptor& field) {
    if (node.kind != Node::Kind::list) {
      problem(node.at, path, "expected a list, got " + what_is(node),
              field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE ? "begin each entry with a dash" : "write [ , ]");
      return;
    }
    int index = 0;
    for (const Node& item : node.items) {
      const std::string item_path = path + "[" + std::to_string(index++) + "]";
      map_.add(item_path, item.at);
      read_value(item, item_path, message, field);
    }
  }

  void read_value(const Node& node, const std::string& path, Message& message, const FieldDescriptor& field) {
    const Reflection& r = *message.GetReflection();
    const bool add = field.is_repeated();
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      read_message(node, path, add ? *r.AddMessage(&message, &field) : *r.MutableMessage(&message, &field));
      return;
    }
    if (node.kind != Node::Kind::scalar) {
      problem(node.at, path, "expected " + wanted(field) + ", got " + what_is(node),
              node.kind == Node::Kind::null ? "give a value or remove the key" : "");
      return;
    }
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        if (double value = 0; number(node, path, field, value))
          add ? r.AddDouble(&message, &field, value) : r.SetDouble(&message, &field, value);
        break;
      case FieldDescriptor::CPPTYPE_INT32:
        if (std::int32_t value = 0; integer(node, path, field, value))
          add ? r.AddInt32(&message, &field, value) : r.SetInt32(&message, &field, value);
        break;
      case FieldDescriptor::CPPTYPE_INT64:
        if (std::int64_t value = 0; integer(node, path, field, value))
          add ? r.AddInt64(&message, &field, value) : r.SetInt64(&message, &field, value);
        break;
      case FieldDescriptor::CPPTYPE_UINT64:
        if (std::uint64_t value = 0; integer(node, path, field, value))
          add ? r.AddUInt64(&message, &field, value) : r.SetUInt64(&message, &field, value);
        break;
      case FieldDescriptor::CPPTYPE_BOOL:
        if (node.quoted || (node.text != "true" && node.text != "false"))
          problem(node.at, path, "expected true or false, got " + what_is(node), "");
        else
          add ? r.AddBool(&message, &field, node.text == "true")
              : r.SetBool(&message, &field, node.text == "true");
        break;
      case FieldDescriptor::CPPTYPE_STRING:
        add ? r.AddString(&message, &field, node.text) : r.SetString(&message, &field, node.text);
        break;
      case FieldDescriptor::CPPTYPE_ENUM:
        if (const auto* value = enumerator(node, path, *field.enum_type()))
          add ? r.AddEnum(&message, &field, value) : r.SetEnum(&message, &field, value);
        break;
      default: problem(node.at, path, "this kind of field cannot be written in YAML", "");
    }
  }

  static std::string wanted(const FieldDescriptor& field) {
    const auto unit = split_unit(field.name()).unit;
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE: return unit.empty() ? "a number" : "a number in " + unit_words(unit);
      case FieldDescriptor::CPPTYPE_BOOL: return "true or false";
      case FieldDescriptor::CPPTYPE_STRING: return "text";
      case FieldDescriptor::CPPTYPE_ENUM: return "a word";
      default: return "a whole number";
    }
  }

  bool number(const Node& node, const std::string& path, const FieldDescriptor& field, double& value) {
    std::string text = node.text;
    if (text.starts_with('+')) text.erase(0, 1);
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (node.quoted || text.empty() || rest == text.data()) {
      std::string lower = text;
      for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
      if (lower.ends_with(".nan") || lower.ends_with(".inf"))
        problem(node.at, path, "must be finite, got " + what_is(node), "give a number or remove the key");
      else
        problem(node.at, path, "expected " + wanted(field) + ", got " + what_is(node), "");
      return false;
    }
    if (error == std::errc::result_out_of_range || (rest == end && !std::isfinite(value))) {
      problem(node.at, path, "must be finite, got " + what_is(node), "give a number or remove the key");
      return false;
    }
    if (rest != end) {
      const auto unit = split_unit(field.name()).unit;
      problem(node.at, path, "expected " + wanted(field) + ", got " + what_is(node),
              unit.empty() ? "write the number alone"
                           : "the unit belongs to the key: write the number alone, in " + unit_words(unit));
      return false;
    }
    return true;
  }

  template <class Integer>
  bool integer(const Node& node, const std::string& path, const FieldDescriptor& field, Integer& value) {
    const char* end = node.text.data() + node.text.size();
    const auto [rest, error] = std::from_chars(node.text.data(), end, value);
    if (!node.quoted && error == std::errc{} && rest == end && !node.text.empty()) return true;
    problem(node.at, path,
            error == std::errc::result_out_of_range ? what_is(node) + " is too large"
                                                    : "expected " + wanted(field) + ", got " + what_is(node),
            "");
    return false;
  }

  const EnumValueDescriptor* enumerator(const Node& node, const std::string& path, const EnumDescriptor& type) {
    std::vector<std::string> words;
    for (int i = 0; i < type.value_count(); ++i) {
      const EnumValueDescriptor* value = type.value(i);
      if (value->number() == 0) continue;
      if (short_name(*value) == node.text) return value;
      words.push_back(short_name(*value));
    }
    const std::string near = nearest(node.text, words);
    problem(node.at, path, "unknown word " + what_is(node),
            (near.empty() ? "" : "did you mean " + near + "? ") + ("allowed are " + list(words)));
    return nullptr;
  }

  SourceMap map_;
  std::vector<Problem> problems_;
};

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    static constexpr std::string_view hex = "0123456789abcdef";
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (code < 0x20 || code == 0x7f) {
      out += "\\x";
      out += hex[code >> 4];
      out += hex[code & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string scalar(const Message& m, const FieldDescriptor& f, int index) {
  const Reflection& r = *m.GetReflection();
  const bool many = f.is_repeated();
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      std::array<char, 32> buffer{};
      const double value = many ? r.GetRepeatedDouble(m, &f, index) : r.GetDouble(m, &f);
      return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
    }
    case FieldDescriptor::CPPTYPE_INT32:
      return std::to_string(many ? r.GetRepeatedInt32(m, &f, index) : r.GetInt32(m, &f));
    case FieldDescriptor::CPPTYPE_INT64:
      return std::to_string(many ? r.GetRepeatedInt64(m, &f, index) : r.GetInt64(m, &f));
    case FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(many ? r.GetRepeatedUInt64(m, &f, index) : r.GetUInt64(m, &f));
    case FieldDescriptor::CPPTYPE_BOOL:
      return (many ? r.GetRepeatedBool(m, &f, index) : r.GetBool(m, &f)) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return short_name(*(many ? r.GetRepeatedEnum(m, &f, index) : r.GetEnum(m, &f)));
    case FieldDescriptor::CPPTYPE_STRING:
      return quoted(many ? r.GetRepeatedString(m, &f, index) : r.GetString(m, &f));
    default: return "~";
  }
}

void write_message(const Message& m, int indent, std::string first, std::string& out) {
  const Reflection& r = *m.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  r.ListFields(m, &fields);
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  if (fields.empty()) {
    out += first + "{}\n";
    return;
  }
  for (const FieldDescriptor* f : fields) {
    const std::string lead = (first.empty() ? margin : first) + f->name() + ":";
    first.clear();
    const bool message = f->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    if (!f->is_repeated() && message) {
      const Message& inner = r.GetMessage(m, f);
      std::vector<const FieldDescriptor*> set;
      inner.GetReflection()->ListFields(inner, &set);
      out += lead + (set.empty() ? " " : "\n");
      write_message(inner, indent + 2, "", out);
    } else if (!f->is_repeated()) {
      out += lead + " " + scalar(m, *f, 0) + "\n";
    } else if (message) {
      out += lead + "\n";
      for (int i = 0; i < r.FieldSize(m, f); ++i)
        write_message(r.GetRepeatedMessage(m, f, i), indent + 4, margin + "  - ", out);
    } else {
      out += lead + " [";
      for (int i = 0; i < r.FieldSize(m, f); ++i) {
        if (i > 0) out += ", ";
        out += scalar(m, *f, i);
      }
      out += "]\n";
    }
  }
}

std::string all_text(const std::string& file, const std::vector<Problem>& problems) {
  std::string out;
  for (const Problem& p : problems) {
    if (!out.empty()) out += '\n';
    out += to_text(file, p);
  }
  return out;
}

}  // namespace

std::string to_text(const std::string& file, const Problem& problem) {
  std::string out = file;
  if (problem.at.line > 0) {
    out += (out.empty() ? "line " : ":") + std::to_string(problem.at.line);
    if (problem.at.column > 0) out += ":" + std::to_string(problem.at.column);
  }
  if (!out.empty()) out += ": ";
  if (!problem.field.empty()) out += problem.field + ": ";
  out += problem.message;
  if (!problem.hint.empty()) out += "; " + problem.hint;
  return out;
}

InputError::InputError(const std::string& file, std::vector<Problem> problems)
    : std::runtime_error(all_text(file, problems)), problems_(std::move(problems)) {}

Position SourceMap::find(std::string field) const {
  while (!field.empty()) {
    if (const auto found = positions_.find(field); found != positions_.end()) return found->second;
    const auto cut = field.find_last_of(".[");
    if (cut == std::string::npos) break;
    field.erase(cut);
  }
  return {};
}

SourceMap read(std::string_view text, const std::string& file, Message& message) {
  const Node root = parse(text, file);
  Reader reader(file);
  if (root.kind != Node::Kind::null) reader.read_message(root, "", message);
  return reader.finish();
}

SourceMap read_file(const std::string& path, Message& message) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, {{{}, "", "cannot be opened", "check the path"}});
  std::string text;
  text.resize(max_bytes + 1);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw InputError(path, {{{}, "", "cannot be read", ""}});
  text.resize(static_cast<std::size_t>(in.gcount()));
  return read(text, path, message);
}

std::string write(const Message& message) {
  std::string out;
  write_message(message, 0, "", out);
  return out;
}

}  // namespace seaway::yaml
