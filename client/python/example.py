#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Submits a rolling barge, watches it, and prints its stages.

    PYTHONPATH=build/release/python:client/python client/python/example.py 127.0.0.1:7411
"""

import sys

from seaway.v1 import case_pb2, job_pb2

import seaway_client


def barge():
    """A free barge in calm water, heeled by 15 degrees at the start: two stages."""
    case = case_pb2.Case(title="Roll decay of a barge, from Python", dimension=2)
    case.tank.y_m.extend([-3.5, 3.5])
    case.tank.z_m.extend([-0.9, 0.45])
    case.mesh.base_cell_m = 0.08
    case.wave.calm.SetInParent()
    case.hull.box.beam_m = 0.3
    case.hull.box.height_m = 0.1
    case.body.mass_kg_per_m = 15
    case.body.cog.z_m = 0.05
    case.body.gyradii.x_m = 0.13
    case.body.free.append(case_pb2.DOF_ROLL)
    case.body.angles.roll_deg = 15
    for cell in (0.02, 0.01):
        stage = case.cascade.stages.add()
        stage.mesh.hull_cell_m = cell
        stage.mesh.surface.add(cell_m=cell, half_height_m=0.1)
        stage.end.time.duration_s = 0.5
    return case


def main():
    client = seaway_client.Client(sys.argv[1] if len(sys.argv) > 1 else "127.0.0.1:7411")
    job = client.submit(barge())
    print("submitted", job.name)
    received = 0
    for message in client.watch(job.name):
        if message.HasField("chunk"):
            received += len(message.chunk.times_s)
        elif message.HasField("mark"):
            progress = message.mark.progress
            print(f"stage {progress.stage + 1}/{progress.stage_count} {100 * progress.fraction:.0f} %")
    job = client.wait(job.name)
    print(job_pb2.Job.State.Name(job.state), "samples", received)
    for stage in client.stages(job.name):
        print(f"{stage.name}: {stage.cell_count} cells, {stage.step_count} steps, {stage.cpu_s:.2f} CPU s")
    history = client.history(job.name)
    same = len(history["time"]) == received == job.latest_sequence
    return 0 if job.state == job_pb2.Job.STATE_SUCCEEDED and same else 1


if __name__ == "__main__":
    sys.exit(main())
