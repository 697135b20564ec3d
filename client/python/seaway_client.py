# SPDX-License-Identifier: GPL-3.0-or-later
"""Submit cases to seawayd and follow them from Python.

Works with Debian's python3-grpcio and python3-protobuf and the modules that the build makes in
build/<preset>/python (add that folder to PYTHONPATH). One Client may be used from several threads.

    client = Client("127.0.0.1:7411")
    job = client.submit(case)                 # seaway.v1 Case message
    for event in client.watch(job.name):      # survives broken connections
        ...
"""

import time
import uuid

import grpc

from seaway.v1 import job_pb2, job_service_pb2 as service, job_service_pb2_grpc as stubs

TERMINAL = (job_pb2.Job.STATE_SUCCEEDED, job_pb2.Job.STATE_FAILED, job_pb2.Job.STATE_CANCELLED)
_AGAIN = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED, grpc.StatusCode.INTERNAL)


class Client:
    """The service at `address`. Calls raise grpc.RpcError with the status of the service."""

    def __init__(self, address="127.0.0.1:7411", timeout_s=10.0):
        options = [
            ("grpc.keepalive_time_ms", 30000),
            ("grpc.keepalive_timeout_ms", 10000),
            ("grpc.keepalive_permit_without_calls", 1),
            ("grpc.initial_reconnect_backoff_ms", 200),
            ("grpc.min_reconnect_backoff_ms", 2000),
            ("grpc.max_reconnect_backoff_ms", 2000),
            ("grpc.enable_http_proxy", 0),
        ]
        self._channel = grpc.insecure_channel(address, options=options)
        self._timeout_s = timeout_s
        self.jobs = stubs.JobsStub(self._channel)
        self.telemetry = stubs.TelemetryStub(self._channel)
        self.stages_stub = stubs.StagesStub(self._channel)
        self.artifacts_stub = stubs.ArtifactsStub(self._channel)
        self.cases = stubs.CasesStub(self._channel)

    def close(self):
        self._channel.close()

    def submit(self, case, files=None, request_id=None):
        """Queues `case`; `files` maps names in the case to bytes. The same request_id gives the same job."""
        request = service.CreateJobRequest(case=case, request_id=request_id or str(uuid.uuid4()))
        for name, content in (files or {}).items():
            request.files.add(name=name, content=content)
        return self.jobs.CreateJob(request, timeout=60).job

    def validate(self, case, files=None):
        """Diagnostics, hydrostatics and cost; queues nothing."""
        request = service.ValidateCaseRequest(case=case)
        for name, content in (files or {}).items():
            request.files.add(name=name, content=content)
        return self.cases.ValidateCase(request, timeout=60)

    def get(self, name):
        return self.jobs.GetJob(service.GetJobRequest(name=name), timeout=self._timeout_s)

    def cancel(self, name):
        return self.jobs.CancelJob(service.CancelJobRequest(name=name), timeout=self._timeout_s)

    def wait(self, name, poll_s=0.5):
        """Polls until the job has ended."""
        while True:
            job = self.get(name)
            if job.state in TERMINAL:
                return job
            time.sleep(poll_s)

    def watch(self, name, after_sequence=0):
        """Yields the messages of the stream until the job has ended. A broken connection is taken up again
        after the last sample, so every sample comes once and in order."""
        last = after_sequence
        while True:
            request = service.WatchSamplesRequest(job=name, after_sequence=last)
            try:
                for message in self.telemetry.WatchSamples(request):
                    if message.HasField("chunk"):
                        chunk = message.chunk
                        if chunk.first_sequence != last + 1:
                            raise RuntimeError(f"sample {chunk.first_sequence} came after {last}")
                        last += len(chunk.times_s)
                    yield message
                return
            except grpc.RpcError as error:
                if error.code() not in _AGAIN:
                    raise
                time.sleep(0.5)

    def history(self, name):
        """The stored history as a dictionary: time and channel name -> list of values."""
        columns, channels, after = {"time": []}, [], 0
        while True:
            request = service.ReadSamplesRequest(job=name, after_sequence=after, page_size=5000)
            page = self.telemetry.ReadSamples(request, timeout=30)
            channels = [channel.name for channel in page.header.channels]
            if not page.chunk.times_s:
                return columns
            columns["time"].extend(page.chunk.times_s)
            for channel, column in zip(channels, page.chunk.columns):
                columns.setdefault(channel, []).extend(column.values)
            after = page.chunk.first_sequence + len(page.chunk.times_s) - 1

    def stages(self, name):
        return self.stages_stub.ListStages(service.ListStagesRequest(job=name), timeout=self._timeout_s).stages
