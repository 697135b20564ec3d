// SPDX-License-Identifier: GPL-3.0-or-later
// The history as CSV: one format for `seaway history` and seaway-run, so that two runs can be compared
// byte by byte. Numbers are the shortest text that reads back to the same bits.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>

#include "seaway/v1/result.pb.h"

namespace seaway::history_csv {

/// `sequence,stage,step,time [s],heave [m],roll [deg],...` and a line end.
std::string header(const google::protobuf::RepeatedPtrField<v1::ChannelSchema>& channels);

/// One line a sample, appended to `out`.
void append(const v1::SampleChunk& chunk, std::string& out);

}  // namespace seaway::history_csv
