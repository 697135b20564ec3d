// Table and picture of the cascade beside the single mesh.
#pragma once

#include <string>

#include "tests/validation/support/run_record.hpp"

namespace seaway::validation {

/// Stages of both runs as a Markdown table.
std::string table_of(const RunRecord& cascade, const RunRecord& single);

/// Roll and heave over time as SVG, changes of stage marked.
std::string picture_of(const RunRecord& cascade, const RunRecord& single);

}  // namespace seaway::validation
