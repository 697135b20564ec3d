#include "tests/validation/results.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/run_context.hpp"

namespace seaway::validation {
namespace {

std::string to_json(const Line& line) {
  nlohmann::ordered_json j;
  j["case"] = line.case_name;
  j["quantity"] = line.quantity;
  j["value"] = json_number(line.value);
  j["unit"] = line.unit;
  j["reference"] = json_number(line.reference);
  j["tolerance"] = json_number(line.tolerance);
  j["pass"] = line.pass;
  j["cpu_s"] = line.cpu_s;
  return j.dump();
}

std::string column(std::optional<double> x) { return x ? fmt::format("{:.6g}", *x) : "-"; }

}  // namespace

Results::Results(std::string case_name, Format format, std::FILE* out)
    : format_(format), out_(out), cpu_before_(process_cpu_seconds()) {
  record_.name = std::move(case_name);
}

void Results::print_table_header(std::FILE* out) {
  std::fprintf(out, "%-18s %-24s %13s %-7s %12s %12s  %-4s %8s\n", "case", "quantity", "value",
               "unit", "reference", "tolerance", "", "cpu_s");
}

void Results::add(Line line) {
  line.case_name = record_.name;
  line.pass = line.pass && !std::isnan(line.value);
  const double cpu = process_cpu_seconds();
  line.cpu_s = cpu - cpu_before_;
  cpu_before_ = cpu;
  record_.cpu_s += line.cpu_s;
  record_.lines.push_back(line);
  print(line);
}

void Results::replay(const CaseRecord& record) {
  record_ = record;
  for (const Line& line : record_.lines) print(line);
}

void Results::print(const Line& line) const {
  if (format_ == Format::json) {
    std::fprintf(out_, "%s\n", to_json(line).c_str());
  } else {
    std::fprintf(out_, "%-18s %-24s %13s %-7s %12s %12s  %-4s %8.2f\n", line.case_name.c_str(),
                 line.quantity.c_str(), column(line.value).c_str(), line.unit.c_str(),
                 column(line.reference).c_str(), column(line.tolerance).c_str(),
                 line.pass ? "ok" : "FAIL", line.cpu_s);
  }
  std::fflush(out_);
}

void Results::expect_below(const std::string& quantity, double value, const std::string& unit,
                           double limit) {
  add({{}, quantity, value, unit, std::nullopt, limit, value <= limit});
}

void Results::expect_above(const std::string& quantity, double value, const std::string& unit,
                           double limit) {
  add({{}, quantity, value, unit, limit, std::nullopt, value >= limit});
}

void Results::expect_near(const std::string& quantity, double value, const std::string& unit,
                          double reference, double tolerance) {
  add({{}, quantity, value, unit, reference, tolerance, std::abs(value - reference) <= tolerance});
}

void Results::report(const std::string& quantity, double value, const std::string& unit) {
  add({{}, quantity, value, unit, std::nullopt, std::nullopt, true});
}

void Results::fail(const std::string& reason) {
  std::fprintf(stderr, "%s: %s\n", record_.name.c_str(), reason.c_str());
  record_.error = reason;
  add({{},
       "error",
       std::numeric_limits<double>::quiet_NaN(),
       "1",
       std::nullopt,
       std::nullopt,
       false});
}

}  // namespace seaway::validation
