#include "tests/validation/cases.hpp"

namespace seaway::validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {"mapping", Suite::quick, "fields from one mesh to the next: kept, conserved, bounded, accurate",
       run_mapping},
  };
  return cases;
}

}  // namespace seaway::validation
