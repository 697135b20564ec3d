-- SPDX-License-Identifier: GPL-3.0-or-later
-- Attempts that ended by a fault of their worker, and how long a job has computed.
ALTER TABLE jobs ADD COLUMN faults INTEGER NOT NULL DEFAULT 0; -- in a row without a new sample
ALTER TABLE jobs ADD COLUMN run_ms INTEGER NOT NULL DEFAULT 0; -- over all attempts, from a monotonic clock
