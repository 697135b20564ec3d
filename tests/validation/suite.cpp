#include "tests/validation/suite.hpp"

#include <fmt/chrono.h>

#include <chrono>
#include <optional>

#include "tests/validation/report/kept_cases.hpp"
#include "tests/validation/report/report.hpp"

namespace seaway::validation {
namespace {

std::string now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
}

/// What a case reads besides the program: its folder and the examples.
std::string inputs_of(const Case& c) {
  return digest_of_folders({std::string(SEAWAY_VALIDATION) + "/" + (c.folder.empty() ? c.name : c.folder), SEAWAY_EXAMPLES});
}

void run_case(const Case& c, const Context& context, Results& results) {
  try {
    c.run(context, results);
  } catch (const std::exception& e) {
    results.fail(e.what());
  }
  if (results.lines() == 0) results.fail("the case reported nothing");
}

/// The part of a run that keeps records and writes the report.
class ReportKeeper {
 public:
  ReportKeeper(const std::string& folder, const std::vector<const Case*>& cases) : kept_(folder) {
    input_.code = code_identity();
    for (const Case* c : cases) input_.missing.push_back(c->name);
  }
  std::string runs_folder() const { return kept_.runs_folder(input_.code); }
  std::optional<CaseRecord> finished(const Case& c, const std::string& form) const {
    return kept_.finished(c.name, form, input_.code, inputs_of(c));
  }
  /// Of a case just run: kept, and in the report. The report is whole after each case.
  void add(const Case& c, CaseRecord record, const std::string& form) {
    if (record.ended.empty()) {
      record.what = c.what;
      record.form = form;
      record.code = input_.code;
      record.digest = inputs_of(c);
      record.ended = now();
      kept_.keep(record);
    }
    std::erase(input_.missing, c.name);
    input_.cases.push_back(std::move(record));
    write_report(input_, kept_.folder());
  }

 private:
  KeptCases kept_;
  ReportInput input_;
};

int status_of(int lines, int failures, Format format) {
  if (format == Format::table) std::printf("%d quantities, %d failed\n", lines, failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace

const char* name_of(Suite suite) { return suite == Suite::quick ? "quick" : suite == Suite::full ? "full" : "ships"; }

int run_suite(const std::vector<const Case*>& cases, Context context, Format format, const std::string& report) {
  std::optional<ReportKeeper> keeper;
  if (!report.empty()) {
    keeper.emplace(report, cases);
    if (context.results.empty()) context.results = keeper->runs_folder();
  }
  const std::string form = name_of(context.suite);
  int lines = 0, failures = 0;
  if (format == Format::table) Results::print_table_header(stdout);
  for (const Case* c : cases) {
    Results results(c->name, format);
    const auto before = keeper ? keeper->finished(*c, form) : std::nullopt;
    if (before) results.replay(*before);
    else run_case(*c, context, results);
    if (keeper) keeper->add(*c, results.record(), form);
    lines += results.lines();
    failures += results.failures();
  }
  return status_of(lines, failures, format);
}

int report_kept(const std::string& folder) {
  ReportInput input{KeptCases(folder).all(), {}, code_identity()};
  write_report(input, folder);
  int lines = 0, failures = 0;
  for (const CaseRecord& r : input.cases) {
    lines += static_cast<int>(r.lines.size());
    failures += r.failures();
  }
  return status_of(lines, failures, Format::table);
}

}  // namespace seaway::validation
