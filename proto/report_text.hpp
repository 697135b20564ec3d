// SPDX-License-Identifier: GPL-3.0-or-later
// Results as text for a person: the same tables from `seaway` and seaway-run.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>

#include "proto/yaml.hpp"
#include "seaway/v1/result.pb.h"

namespace seaway::report_text {

/// Cells, steps, CPU seconds by phase, mapping time, roll and heave amplitude: one column a stage.
std::string stage_table(const google::protobuf::RepeatedPtrField<v1::StageReport>& stages);

/// Draft, KB, BM, GM, heel, intact values and the dry roll period. `dimension` 2: per metre.
std::string hydrostatics(const v1::Hydrostatics& h, int dimension);

/// Cells, steps and CPU time that a run will need, stage by stage.
std::string cost(const google::protobuf::RepeatedPtrField<v1::StageEstimate>& stages);

/// One line a diagnostic, with file and line where `lines` knows them.
std::string diagnostics(const google::protobuf::RepeatedPtrField<v1::Diagnostic>& list, const yaml::SourceMap& lines);

/// 75 -> 1 min 15 s
std::string duration(double seconds);

/// Pads every cell of a column to its widest; the first column to the left, the others to the right.
std::string align(const std::vector<std::vector<std::string>>& rows);

}  // namespace seaway::report_text
