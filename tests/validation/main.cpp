// seaway-validate: runs validation and verification cases and compares with references.
// Exit status 0: every line passed; 1: one failed; 2: wrong usage.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/mesh/parallel_runtime.hpp"
#include "tests/validation/suite.hpp"

namespace {

using namespace seaway;
using validation::Case;
using validation::Suite;

bool belongs(const Case& c, Suite suite) {
  return suite == Suite::ships ? c.suite == Suite::ships
                               : static_cast<int>(c.suite) <= static_cast<int>(suite);
}

/// The cases to run; empty with a message on stderr if a name is unknown or nothing was asked for.
std::vector<const Case*> choose(const std::vector<std::string>& names, bool by_suite, Suite suite) {
  std::vector<const Case*> chosen;
  for (const std::string& name : names) {
    const auto& all = validation::all_cases();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == name; });
    if (found == all.end()) {
      std::fprintf(stderr, "no case named '%s'; seaway-validate --list names them\n", name.c_str());
      return {};
    }
    chosen.push_back(&*found);
  }
  if (names.empty() && by_suite)
    for (const Case& c : validation::all_cases())
      if (belongs(c, suite)) chosen.push_back(&c);
  if (chosen.empty())
    std::fprintf(stderr, "nothing to run; give case names or --suite quick|full|ships\n");
  return chosen;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Validation and verification cases of seaway: each compares quantities with references."};
  std::vector<std::string> names;
  std::string report;
  bool json = false, list = false;
  Suite suite = Suite::full;
  validation::Context context;
  app.add_option("case", names, "names of cases; none: all of the suite");
  app.add_flag("--json", json, "one JSON object a line instead of a table");
  app.add_flag("--list", list, "print names, suites and purposes of the cases");
  const std::map<std::string, Suite> suites{
      {"quick", Suite::quick}, {"full", Suite::full}, {"ships", Suite::ships}};
  auto* suite_option =
      app.add_option("--suite", suite,
                     "quick | full (all but the ships) | ships; with names: the size "
                     "in which they run, full unless given")
          ->transform(CLI::CheckedTransformer(suites).description("quick|full|ships"));
  app.add_option("--threads", context.threads, "threads; no result depends on them")
      ->check(CLI::Range(1, 256));
  app.add_option(
      "--results", context.results,
      "folder in which long cases keep finished runs, tables and pictures; what is there "
      "is not run again");
  app.add_option("--report", report,
                 "folder for report.json and report.html; each case is kept there as it ends, and what is there of the "
                 "same code and input is not run again; without cases and suite: of what is there");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  if (list) {
    for (const Case& c : validation::all_cases())
      std::printf("%-18s %-6s %s\n", c.name.c_str(), validation::name_of(c.suite), c.what.c_str());
    return 0;
  }
  context.suite = suite;
  if (!report.empty() && names.empty() && suite_option->count() == 0) return validation::report_kept(report);
  const std::vector<const Case*> cases = choose(names, suite_option->count() > 0, suite);
  if (cases.empty()) return 2;
  const mesh::ParallelRuntime runtime;
  return validation::run_suite(cases, context, json ? validation::Format::json : validation::Format::table, report);
}
