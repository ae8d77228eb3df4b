"""Snakemake's logger ``jobs``: write every job of a dry run as a line of JSON, for ``morphoskel plan``.

Snakemake finds it by its name on PYTHONPATH.
"""

import json
from dataclasses import dataclass, field
from logging import LogRecord
from pathlib import Path

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.settings import LogHandlerSettingsBase


@dataclass
class LogHandlerSettings(LogHandlerSettingsBase):
    """The option ``--logger-jobs-path``."""

    path: Path = field(default=Path("jobs.jsonl"), metadata={"help": "file that the jobs are appended to"})


class LogHandler(LogHandlerBase):
    """Append rule, wildcards, threads, resources, inputs and outputs of each job."""

    writes_to_stream = False
    writes_to_file = True
    has_filter = True
    has_formatter = True
    needs_rulegraph = False

    def __post_init__(self) -> None:
        assert isinstance(self.settings, LogHandlerSettings)
        self.baseFilename = str(self.settings.path)

    def emit(self, record: LogRecord) -> None:
        """Write one line if the record tells of a job."""
        told = vars(record)
        if told.get("event") != LogEvent.JOB_INFO:
            return
        job = {
            "rule": told["rule_name"],
            "wildcards": dict(told["wildcards"] or {}),
            "threads": told["threads"],
            "gpus": int(told["resources"].get("gpu", 0)),
            "inputs": [str(path) for path in told["input"]],
            "outputs": [str(path) for path in told["output"]],
        }
        with Path(self.baseFilename).open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(job) + "\n")
