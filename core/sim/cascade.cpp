#include "core/sim/cascade.hpp"

#include "core/base/error.hpp"
#include "core/sim/cascade_run.hpp"
#include "core/sim/check_case.hpp"

namespace seaway::sim {

RunOutcome run_cascade(const Case& c, const RunOptions& options, RunObserver& observer, const RunContext& context) {
  for (const Diagnostic& d : check_case(c).diagnostics) {
    if (d.severity == Diagnostic::Severity::error)
      fail(ErrorCode::invalid_argument, "{}: {}; {}", d.field, d.message, d.hint);
  }
  return c.dim == 2 ? CascadeRun<2>(c, options, observer, context).run()
                    : CascadeRun<3>(c, options, observer, context).run();
}

}  // namespace seaway::sim
