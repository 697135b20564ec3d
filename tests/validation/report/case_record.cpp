#include "tests/validation/report/case_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

using nlohmann::ordered_json;

ordered_json numbers(const std::vector<double>& v) {
  ordered_json out = ordered_json::array();
  for (const double x : v) out.push_back(json_number(x));
  return out;
}

double number(const ordered_json& j) { return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>(); }

std::optional<double> optional_number(const ordered_json& j) {
  if (j.is_null()) return std::nullopt;
  return j.get<double>();
}

std::vector<double> vector_of(const ordered_json& j) {
  std::vector<double> out;
  for (const auto& x : j) out.push_back(number(x));
  return out;
}

ordered_json to_json(const Plot& p) {
  ordered_json curves = ordered_json::array();
  for (const Curve& c : p.curves)
    curves.push_back({{"label", c.label}, {"reference", c.reference}, {"x", numbers(c.x)}, {"y", numbers(c.y)}});
  return {{"title", p.title}, {"x_label", p.x_label}, {"y_label", p.y_label}, {"log_axes", p.log_axes}, {"curves", curves}};
}

Plot plot_from(const ordered_json& j) {
  Plot p{j.at("title"), j.at("x_label"), j.at("y_label"), {}, j.at("log_axes")};
  for (const auto& c : j.at("curves"))
    p.curves.push_back({c.at("label"), vector_of(c.at("x")), vector_of(c.at("y")), c.at("reference")});
  return p;
}

ordered_json to_json(const Refinement& r) {
  return {{"quantity", r.quantity},         {"unit", r.unit},     {"h", numbers(r.h)},
          {"value", numbers(r.value)},      {"formal_order", r.formal_order},
          {"reference", json_number(r.reference)}, {"u_data", r.u_data}, {"u_input", r.u_input}};
}

Refinement refinement_from(const ordered_json& j) {
  return {j.at("quantity"),     j.at("unit"),   vector_of(j.at("h")), vector_of(j.at("value")), j.at("formal_order"),
          optional_number(j.at("reference")), j.at("u_data"), j.at("u_input")};
}

}  // namespace

ordered_json json_number(std::optional<double> x) {
  return x && std::isfinite(*x) ? ordered_json(*x) : ordered_json(nullptr);
}

int CaseRecord::failures() const {
  return static_cast<int>(std::count_if(lines.begin(), lines.end(), [](const Line& l) { return !l.pass; }));
}

ordered_json to_json(const CaseRecord& r) {
  ordered_json lines = ordered_json::array(), plots = ordered_json::array(), refinements = ordered_json::array();
  for (const Line& l : r.lines)
    lines.push_back({{"quantity", l.quantity},
                     {"value", json_number(l.value)},
                     {"unit", l.unit},
                     {"reference", json_number(l.reference)},
                     {"tolerance", json_number(l.tolerance)},
                     {"pass", l.pass},
                     {"cpu_s", l.cpu_s}});
  for (const Plot& p : r.plots) plots.push_back(to_json(p));
  for (const Refinement& x : r.refinements) refinements.push_back(to_json(x));
  return {{"case", r.name},   {"what", r.what},   {"form", r.form},   {"code", r.code},     {"digest", r.digest},
          {"ended", r.ended}, {"error", r.error}, {"cpu_s", r.cpu_s}, {"lines", lines},     {"plots", plots},
          {"refinements", refinements}};
}

CaseRecord record_from(const ordered_json& j) {
  try {
    CaseRecord r{j.at("case"), j.at("what"), j.at("form"), j.at("code"), j.at("digest"), j.at("ended"),
                 j.at("error"), j.at("cpu_s"), {}, {}, {}};
    for (const auto& l : j.at("lines"))
      r.lines.push_back({r.name, l.at("quantity"), number(l.at("value")), l.at("unit"), optional_number(l.at("reference")),
                         optional_number(l.at("tolerance")), l.at("pass"), l.at("cpu_s")});
    for (const auto& p : j.at("plots")) r.plots.push_back(plot_from(p));
    for (const auto& x : j.at("refinements")) r.refinements.push_back(refinement_from(x));
    return r;
  } catch (const nlohmann::json::exception& e) {
    fail(ErrorCode::data_loss, "not the record of a case: {}", e.what());
  }
}

}  // namespace seaway::validation
