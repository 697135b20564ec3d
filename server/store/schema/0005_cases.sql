-- SPDX-License-Identifier: GPL-3.0-or-later
-- A case is stored once, whatever the number of jobs that have it: with its tables it is the largest part of a job.
CREATE TABLE case_specs (
  digest TEXT PRIMARY KEY NOT NULL,
  spec BLOB NOT NULL
);
INSERT INTO case_specs SELECT digest, spec FROM jobs GROUP BY digest;

-- Apart from the cases, because it changes with each submit.
CREATE TABLE case_uses (
  digest TEXT PRIMARY KEY NOT NULL,
  jobs INTEGER NOT NULL -- that have this case; it goes with the last of them
) WITHOUT ROWID;
INSERT INTO case_uses SELECT digest, count(*) FROM jobs GROUP BY digest;

ALTER TABLE jobs DROP COLUMN spec;
