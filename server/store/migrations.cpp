// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/migrations.hpp"

#include <array>

#include "core/base/error.hpp"
#include "server/store/schema_sql.hpp"  // made from schema/*.sql by the build

namespace seaway::store {

int schema_version() { return static_cast<int>(schema_steps.size()); }

int version_of(Database& db) {
  Statement query = db.prepare("PRAGMA user_version");
  return query.step() ? static_cast<int>(query.integer(0)) : 0;
}

void migrate(Database& db) { migrate_to(db, schema_version()); }

void migrate_to(Database& db, int target) {
  int version = version_of(db);
  if (version > schema_version())
    fail(ErrorCode::failed_precondition,
         "the database has schema {}, this program knows {}; start a newer seawayd", version, schema_version());
  for (; version < target; ++version) {
    db.execute("BEGIN IMMEDIATE");
    try {
      db.execute(std::string(schema_steps[static_cast<std::size_t>(version)]));
      db.execute("PRAGMA user_version=" + std::to_string(version + 1));
      db.execute("COMMIT");
    } catch (...) {
      db.execute("ROLLBACK");
      throw;
    }
  }
}

}  // namespace seaway::store
