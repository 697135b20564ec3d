-- SPDX-License-Identifier: GPL-3.0-or-later
-- Priorities, labels, notes; changes without gaps; what is known of deleted jobs; who did what.
ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN take_mark INTEGER NOT NULL DEFAULT 0; -- jobs started before this one was queued
ALTER TABLE jobs ADD COLUMN rank INTEGER NOT NULL DEFAULT 0;      -- 10 priority - take_mark; the largest goes first
ALTER TABLE jobs ADD COLUMN note TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN base_uid TEXT NOT NULL DEFAULT '';
CREATE INDEX jobs_by_rank ON jobs (state, rank DESC, id);
CREATE INDEX jobs_by_end ON jobs (ended_ns) WHERE ended_ns > 0;

CREATE TABLE counters (
  name TEXT PRIMARY KEY,
  value INTEGER NOT NULL
) WITHOUT ROWID;
INSERT INTO counters VALUES ('takes', 0);

CREATE TABLE labels (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  key TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (job, key)
) WITHOUT ROWID;
CREATE INDEX labels_by_value ON labels (key, value, job);

-- What WatchJobs sends: stays when its job is deleted, and is cut at the old end only.
CREATE TABLE changes (
  revision INTEGER PRIMARY KEY AUTOINCREMENT,
  uid TEXT NOT NULL,
  kind TEXT NOT NULL,
  state INTEGER NOT NULL,
  time_ns INTEGER NOT NULL
);

-- Deleted jobs, so that a late repetition of their submit is recognised.
CREATE TABLE tombstones (
  request_id TEXT PRIMARY KEY,
  uid TEXT NOT NULL,
  deleted_ns INTEGER NOT NULL
) WITHOUT ROWID;

CREATE TABLE audit (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  time_ns INTEGER NOT NULL,
  principal TEXT NOT NULL,
  peer TEXT NOT NULL,
  method TEXT NOT NULL,
  target TEXT NOT NULL,
  outcome TEXT NOT NULL
);

-- Smallest and largest values of runs of samples: level 1 of 16, level 2 of 256; made with the sealed chunks.
CREATE TABLE envelopes (
  job INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  level INTEGER NOT NULL,
  first_sequence INTEGER NOT NULL,
  crc INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (job, level, first_sequence)
) WITHOUT ROWID;
