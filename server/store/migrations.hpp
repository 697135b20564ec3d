// SPDX-License-Identifier: GPL-3.0-or-later
// The numbered steps of server/store/schema, applied in order.
#pragma once

#include "server/store/database.hpp"

namespace seaway::store {

/// Version of the schema in the file; 0: a new one.
int version_of(Database& db);
/// Brings the schema up to date, one transaction a step. Throws failed_precondition if it is newer.
void migrate(Database& db);
/// As migrate(), up to a step; for tests of upgrades.
void migrate_to(Database& db, int version);
/// The version that migrate() ends with.
int schema_version();

}  // namespace seaway::store
