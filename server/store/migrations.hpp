// SPDX-License-Identifier: GPL-3.0-or-later
// The numbered steps of server/store/schema, applied in order.
#pragma once

#include "server/store/database.hpp"

namespace seaway::store {

/// Brings the schema up to date, one transaction a step. Throws failed_precondition if it is newer.
void migrate(Database& db);
/// The version that migrate() ends with.
int schema_version();

}  // namespace seaway::store
