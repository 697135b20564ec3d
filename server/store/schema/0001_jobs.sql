-- SPDX-License-Identifier: GPL-3.0-or-later
-- Jobs, what happened to them and what their runs produced. Times are nanoseconds since 1970 (UTC).
CREATE TABLE jobs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  uid TEXT NOT NULL UNIQUE,
  request_id TEXT NOT NULL UNIQUE,
  title TEXT NOT NULL,
  state INTEGER NOT NULL,
  reason INTEGER NOT NULL DEFAULT 0,
  message TEXT NOT NULL DEFAULT '',
  attempt INTEGER NOT NULL DEFAULT 0,
  stalled_attempts INTEGER NOT NULL DEFAULT 0,
  attempt_sequence INTEGER NOT NULL DEFAULT 0, -- last_sequence when the attempt began
  digest TEXT NOT NULL,
  code_version TEXT NOT NULL,
  spec BLOB NOT NULL,
  created_ns INTEGER NOT NULL,
  started_ns INTEGER NOT NULL DEFAULT 0,
  ended_ns INTEGER NOT NULL DEFAULT 0,
  updated_ns INTEGER NOT NULL,
  stage INTEGER NOT NULL DEFAULT 0,
  stage_count INTEGER NOT NULL DEFAULT 0,
  time_s REAL NOT NULL DEFAULT 0,
  fraction REAL NOT NULL DEFAULT 0,
  remaining_s REAL NOT NULL DEFAULT -1,
  held INTEGER NOT NULL DEFAULT 0,
  last_sequence INTEGER NOT NULL DEFAULT 0,
  checkpoint_sequence INTEGER NOT NULL DEFAULT 0
);
CREATE INDEX jobs_by_state ON jobs (state, id);

CREATE TABLE attempts (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  attempt INTEGER NOT NULL,
  first_sequence INTEGER NOT NULL,
  started_ns INTEGER NOT NULL,
  ended_ns INTEGER NOT NULL DEFAULT 0,
  outcome TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (job, attempt)
) WITHOUT ROWID;

CREATE TABLE events (
  revision INTEGER PRIMARY KEY AUTOINCREMENT,
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  time_ns INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  kind TEXT NOT NULL,
  text TEXT NOT NULL
);
CREATE INDEX events_by_job ON events (job, revision);

CREATE TABLE channels (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  PRIMARY KEY (job, position)
) WITHOUT ROWID;

CREATE TABLE sample_chunks (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  first_sequence INTEGER NOT NULL,
  n INTEGER NOT NULL,
  t_first REAL NOT NULL,
  t_last REAL NOT NULL,
  codec INTEGER NOT NULL, -- 0: raw little-endian
  crc INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (job, first_sequence)
);

CREATE TABLE stages (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  stage INTEGER NOT NULL,
  report BLOB NOT NULL,
  PRIMARY KEY (job, stage)
) WITHOUT ROWID;

CREATE TABLE artifacts (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  name TEXT NOT NULL,
  path TEXT NOT NULL,
  media_type TEXT NOT NULL,
  size INTEGER NOT NULL,
  created_ns INTEGER NOT NULL,
  PRIMARY KEY (job, name)
) WITHOUT ROWID;

CREATE TABLE checkpoints (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  path TEXT NOT NULL,
  sequence INTEGER NOT NULL,
  size INTEGER NOT NULL,
  mtime_ns INTEGER NOT NULL,
  inode INTEGER NOT NULL,
  created_ns INTEGER NOT NULL,
  PRIMARY KEY (job, path)
) WITHOUT ROWID;
