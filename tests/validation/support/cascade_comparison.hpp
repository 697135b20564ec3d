// A run through the meshes of a cascade against one on the finest mesh alone: how far their answers are apart, what was saved.
#pragma once

#include <optional>

#include "tests/validation/results.hpp"
#include "tests/validation/support/run_record.hpp"

namespace seaway::validation {

/// The finest mesh from the start: a stage that ends when the motions have converged by the rule of the cascade's last
/// stage (at most in as many periods as all its stages may take), then one without end: stop it when the cascade's time is
/// reached, so that both can be compared at one time.
sim::Case single_mesh(const sim::Case& cascade);

struct CascadeBars {
  double difference = 0.02;  ///< of the amplitudes of roll and heave, of the single mesh's
  double cpu_saved = 0.5;    ///< at one time of the run, at least
  std::optional<double> cpu_saved_to_answer = std::nullopt;  ///< either stopped when its motions have converged, at least; not set: reported
  double mapping_share = 0.02;                ///< of the cascade's CPU time
};

/// Compares the runs of a cascade `c` and of its single_mesh: amplitudes over the last three periods, CPU times.
void compare_cascade(const sim::Case& c, const RunRecord& cascade, const RunRecord& single, const CascadeBars& bars, Results& results);

}  // namespace seaway::validation
