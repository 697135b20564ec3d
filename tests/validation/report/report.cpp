#include "tests/validation/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "tests/validation/report/svg_plot.hpp"
#include "tests/validation/report/uncertainty.hpp"

namespace seaway::validation {
namespace {

using nlohmann::ordered_json;

constexpr const char* style = R"(<style>
body{font:14px sans-serif;max-width:70em;margin:1em auto;padding:0 1em;color:#222}
table{border-collapse:collapse;margin:.6em 0}td,th{border:1px solid #ccc;padding:2px 8px;text-align:right}
td:first-child,th:first-child{text-align:left}.fail{background:#fbd5d0}.ok{color:#1a7f37}.none{color:#777}
h2{border-bottom:1px solid #ccc;margin-top:2em}svg{margin-right:1em}.note{color:#555}
</style>
)";

/// What is said about one quantity on several meshes; nothing on one mesh or without numbers.
struct Finding {
  std::optional<NumericalUncertainty> numerical;
  std::optional<Comparison> comparison;
  double finest = 0;
};

Finding finding_of(const Refinement& r) {
  Finding out;
  if (r.h.empty() || r.h.size() != r.value.size()) return out;
  for (const double v : r.value)
    if (!std::isfinite(v)) return out;
  out.finest = r.value[static_cast<std::size_t>(std::min_element(r.h.begin(), r.h.end()) - r.h.begin())];
  out.numerical = numerical_uncertainty({r.h, r.value, r.formal_order});
  if (r.reference && out.numerical)
    out.comparison = compare(out.finest, *r.reference, out.numerical->expanded, r.u_input, r.u_data);
  return out;
}

std::string number(std::optional<double> x) { return x && std::isfinite(*x) ? fmt::format("{:.5g}", *x) : "-"; }

std::string limit_of(const Line& l) {
  if (l.reference && l.tolerance) return fmt::format("{} &plusmn; {}", number(l.reference), number(l.tolerance));
  if (l.tolerance) return fmt::format("&le; {}", number(l.tolerance));
  if (l.reference) return fmt::format("&ge; {}", number(l.reference));
  return "";
}

std::string verdict(const Line& l) {
  if (!l.pass) return "<td class='fail'>FAIL</td>";
  return l.reference || l.tolerance ? "<td class='ok'>ok</td>" : "<td class='none'>record</td>";
}

std::string lines_table(const CaseRecord& r) {
  std::string out = "<table><tr><th>quantity</th><th>value</th><th>unit</th><th>wanted</th><th></th><th>CPU s</th></tr>\n";
  for (const Line& l : r.lines)
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}<td>{:.1f}</td></tr>\n", escaped(l.quantity),
                       number(l.value), escaped(l.unit), limit_of(l), verdict(l), l.cpu_s);
  return out + "</table>\n";
}

std::string refinement_plot(const Refinement& r, const Finding& f) {
  Plot plot{r.quantity, "cell", r.quantity + (r.unit == "1" ? "" : ", " + r.unit), {}, false};
  Curve computed{"computed", r.h, r.value, false};
  if (r.reference && *r.reference == 0) {  // an error: its order is a slope
    plot.log_axes = true;
    for (double& v : computed.y) v = std::abs(v);
  }
  plot.curves.push_back(computed);
  if (r.reference && *r.reference != 0) {
    const double widest = *std::max_element(r.h.begin(), r.h.end());
    plot.curves.push_back({"reference", {0, widest}, {*r.reference, *r.reference}, true});
  }
  if (f.numerical && f.numerical->extrapolated && !plot.log_axes)
    plot.curves.push_back({"extrapolated", {0.0}, {*f.numerical->extrapolated}, false});
  return svg_of(plot);
}

std::string refinements_section(const CaseRecord& r) {
  if (r.refinements.empty()) return {};
  std::string rows, plots;
  for (const Refinement& x : r.refinements) {
    const Finding f = finding_of(x);
    plots += refinement_plot(x, f);
    if (!f.numerical) {
      rows += fmt::format("<tr><td>{}</td><td>{}</td><td colspan='8'>one mesh, or a value is missing</td></tr>\n",
                          escaped(x.quantity), number(f.finest));
      continue;
    }
    const NumericalUncertainty& n = *f.numerical;
    std::string last = "<td>-</td><td>-</td><td>-</td>";
    if (f.comparison)
      last = fmt::format("<td>{}</td><td>{}</td><td>{}</td>", number(f.comparison->error), number(f.comparison->u_val),
                         f.comparison->significant() ? "model error larger than 2 u_val" : "within 2 u_val");
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n",
                        escaped(x.quantity), number(f.finest), escaped(x.unit), number(n.order), number(n.extrapolated),
                        number(n.expanded), escaped(n.method), last);
  }
  return "<h3>Grid convergence</h3>\n<table><tr><th>quantity</th><th>finest</th><th>unit</th><th>order</th>"
         "<th>at h = 0</th><th>U (95 %)</th><th>procedure</th><th>E</th><th>u_val</th><th></th></tr>\n" +
         rows + "</table>\n" + plots;
}

std::string case_section(const CaseRecord& r, const std::string& code) {
  std::string out = fmt::format("<h2 id='{0}'>{0}</h2>\n<p>{1}</p>\n", escaped(r.name), escaped(r.what));
  out += fmt::format("<p class='note'>{} form, {:.0f} CPU s, ended {}, code {}{}</p>\n", escaped(r.form), r.cpu_s, escaped(r.ended),
                     escaped(r.code), r.code == code ? "" : " (another than that of this report)");
  if (!r.error.empty()) out += fmt::format("<p class='fail'>Not finished: {}</p>\n", escaped(r.error));
  out += lines_table(r);
  for (const Plot& p : r.plots) out += svg_of(p);
  return out + refinements_section(r);
}

struct Totals {
  int quantities = 0, failed = 0;
};
Totals totals_of(const ReportInput& input) {
  Totals t;
  for (const CaseRecord& r : input.cases) {
    t.quantities += static_cast<int>(r.lines.size());
    t.failed += r.failures();
  }
  return t;
}

std::string overview(const ReportInput& input) {
  std::string out = "<table><tr><th>case</th><th>form</th><th>quantities</th><th>failed</th><th>CPU s</th></tr>\n";
  for (const CaseRecord& r : input.cases)
    out += fmt::format("<tr><td><a href='#{0}'>{0}</a></td><td>{1}</td><td>{2}</td><td{3}>{4}</td><td>{5:.0f}</td></tr>\n",
                       escaped(r.name), escaped(r.form), r.lines.size(), r.failures() > 0 ? " class='fail'" : "", r.failures(),
                       r.cpu_s);
  return out + "</table>\n";
}

ordered_json refinement_json(const Refinement& r, ordered_json j) {
  const Finding f = finding_of(r);
  if (f.numerical) {
    j["procedure"] = f.numerical->method;
    j["order"] = json_number(f.numerical->order);
    j["extrapolated"] = json_number(f.numerical->extrapolated);
    j["expanded_uncertainty"] = json_number(f.numerical->expanded);
  }
  if (f.comparison) {
    j["comparison_error"] = json_number(f.comparison->error);
    j["u_num"] = json_number(f.comparison->u_num);
    j["u_val"] = json_number(f.comparison->u_val);
    j["significant"] = f.comparison->significant();
  }
  return j;
}

void write_aside(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path part = path.string() + ".part";
  {
    std::ofstream file(part, std::ios::binary);
    file << text;
    if (!file.flush()) fail(ErrorCode::unavailable, "cannot write {}", part.string());
  }
  std::filesystem::rename(part, path);
}

}  // namespace

ordered_json report_json(const ReportInput& input) {
  const Totals t = totals_of(input);
  ordered_json cases = ordered_json::array();
  for (const CaseRecord& r : input.cases) {
    ordered_json j = to_json(r);
    for (std::size_t i = 0; i < r.refinements.size(); ++i) j["refinements"][i] = refinement_json(r.refinements[i], j["refinements"][i]);
    cases.push_back(std::move(j));
  }
  return {{"code", input.code},
          {"summary", {{"cases", input.cases.size()}, {"quantities", t.quantities}, {"failed", t.failed}, {"missing", input.missing}}},
          {"cases", cases}};
}

std::string report_html(const ReportInput& input) {
  const Totals t = totals_of(input);
  std::string out = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>seaway: validation</title>\n";
  out += style;
  out += "</head><body>\n<h1>seaway: verification and validation</h1>\n";
  out += fmt::format("<p class='{}'>{} cases, {} quantities, {} failed.</p>\n", t.failed > 0 ? "fail" : "ok", input.cases.size(),
                     t.quantities, t.failed);
  if (!input.missing.empty()) {
    out += "<p class='fail'>Not finished:";
    for (const std::string& name : input.missing) out += fmt::format(" {}", escaped(name));
    out += "</p>\n";
  }
  out += "<p class='note'>Code " + escaped(input.code) +
         ". E: finest value less reference; u_val: standard validation uncertainty (numerical, input, data) after ASME V&amp;V 20. "
         "What each quantity is: tests/validation/CASE/README.md.</p>\n";
  out += overview(input);
  for (const CaseRecord& r : input.cases) out += case_section(r, input.code);
  return out + "</body></html>\n";
}

void write_report(const ReportInput& input, const std::string& folder) {
  std::filesystem::create_directories(folder);
  write_aside(std::filesystem::path(folder) / "report.json", report_json(input).dump(1) + "\n");
  write_aside(std::filesystem::path(folder) / "report.html", report_html(input));
}

}  // namespace seaway::validation
