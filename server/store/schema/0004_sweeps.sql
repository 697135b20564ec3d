-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sweeps: many jobs out of one request. A sweep goes with the last of its jobs.
CREATE TABLE sweeps (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  uid TEXT NOT NULL UNIQUE,
  request_id TEXT NOT NULL UNIQUE,
  title TEXT NOT NULL,
  digest TEXT NOT NULL,
  code_version TEXT NOT NULL,
  spec BLOB NOT NULL,
  created_ns INTEGER NOT NULL
);

CREATE TABLE sweep_jobs (
  sweep INTEGER NOT NULL REFERENCES sweeps (id) ON DELETE CASCADE,
  position INTEGER NOT NULL, -- in the order of the request, from 0
  uid TEXT NOT NULL UNIQUE,  -- of the job; stays when that is deleted
  case_name TEXT NOT NULL,
  period_s REAL NOT NULL,
  height_m REAL NOT NULL,
  heading_deg REAL NOT NULL,
  PRIMARY KEY (sweep, position)
) WITHOUT ROWID;
