// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/convert/checker.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>

namespace seaway::convert {

using google::protobuf::FieldDescriptor;

void Checker::problem(const std::string& field, std::string message, std::string hint) {
  // The first complaint about a field is the useful one.
  for (const sim::Diagnostic& known : problems_)
    if (known.field == field) return;
  if (problems_.size() < 100)
    problems_.push_back({sim::Diagnostic::Severity::error, field, std::move(message), std::move(hint)});
}

double Checker::number(const std::string& field, double value, Range range) {
  const bool low = range.above_lower ? !(value > range.lower) : !(value >= range.lower);
  if (low || !(value <= range.upper)) {
    std::string allowed = fmt::format("{} {}", range.above_lower ? ">" : ">=", range.lower);
    if (range.upper < 1e12) allowed += fmt::format(" and <= {}", range.upper);
    problem(field, fmt::format("{} is not allowed", value),
            value == 0 && range.above_lower ? "give a value " + allowed : "must be " + allowed);
  }
  return value;
}

int Checker::count(const std::string& field, int value, int lower, int upper) {
  if (value < lower || value > upper)
    problem(field, fmt::format("{} is not allowed", value), fmt::format("must be {} to {}", lower, upper));
  return value;
}

void Checker::name(const std::string& field, const std::string& value) {
  const bool ok = !value.empty() && value.size() <= 40 && std::all_of(value.begin(), value.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!ok)
    problem(field, value.empty() ? "is missing" : fmt::format("'{}' is not allowed", value.substr(0, 60)),
            "1 to 40 letters, digits, _ and -");
}

void Checker::line(const std::string& field, const std::string& value, std::size_t most) {
  if (value.size() > most) problem(field, fmt::format("{} bytes", value.size()), fmt::format("must be at most {}", most));
  if (std::any_of(value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    problem(field, "has control characters", "write one line of text");
}

void Checker::entries(const std::string& field, int n, int lower, int upper) {
  if (n < lower || n > upper)
    problem(field, fmt::format("{} entries", n), fmt::format("must be {} to {}", lower, upper));
}

void Checker::finite(const google::protobuf::Message& message, const std::string& path) {
  const auto& r = *message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  r.ListFields(message, &fields);
  for (const FieldDescriptor* f : fields) {
    const int n = f->is_repeated() ? r.FieldSize(message, f) : 1;
    for (int i = 0; i < n; ++i) {
      std::string field = path.empty() ? f->name() : path + "." + f->name();
      if (f->is_repeated()) field += fmt::format("[{}]", i);
      if (f->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
        const double value = f->is_repeated() ? r.GetRepeatedDouble(message, f, i) : r.GetDouble(message, f);
        if (!std::isfinite(value)) problem(field, fmt::format("{} is not a finite number", value), "");
      } else if (f->cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
        const int value = f->is_repeated() ? r.GetRepeatedEnumValue(message, f, i) : r.GetEnumValue(message, f);
        if (f->enum_type()->FindValueByNumber(value) == nullptr)
          problem(field, fmt::format("{} is no value of {}", value, f->enum_type()->name()), "");
      } else if (f->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
        finite(f->is_repeated() ? r.GetRepeatedMessage(message, f, i) : r.GetMessage(message, f), field);
      }
    }
  }
}

}  // namespace seaway::convert
