"""Snakemake's logger plugin ``morphoskel``: a line a job with the time left, and in the end what came of the run.

Snakemake finds it by the name of this package, see ``logger`` in ``profiles/default/config.yaml``. Errors, warnings and
whatever it knows nothing of are printed as Snakemake prints them; so is everything in a dry run, or once something went
wrong in here. Snakemake's own log file, in ``.snakemake/log``, is not touched.
"""

from __future__ import annotations

import os
import sys
import time
from contextlib import suppress
from logging import LogRecord
from typing import Any

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from morphoskel.run_progress.job_lines import JobLines
from morphoskel.run_progress.outcome import Job

COMMAND = "MORPHOSKEL_COMMAND"
"""Environment variable with the command that the user typed, if it was not Snakemake."""

_REPLACED = {LogEvent.JOB_STARTED, LogEvent.PROGRESS}
_CHATTER = "Select jobs to execute..."
_ERASE_LINE = "\r\x1b[K"


class LogHandler(LogHandlerBase):
    """Prints what Snakemake reports."""

    def __post_init__(self) -> None:
        """Make the handler that Snakemake would use, for all that is printed as ever."""
        from snakemake.logging import ColorizingTextHandler, DefaultFilter, DefaultFormatter

        common: Any = self.common_settings
        self._ordinary = ColorizingTextHandler(
            nocolor=common.nocolor,
            stream=sys.stdout if common.stdout else sys.stderr,
            formatter=DefaultFormatter(common.quiet, common.show_failed_logs),
            filter=DefaultFilter(common.quiet, common.debug_dag, common.verbose, common.dryrun, common.printshellcmds),
        )
        self._is_ordinary = bool(common.dryrun)
        self._is_quiet = bool({getattr(kind, "name", kind) for kind in common.quiet or ()} & {"PROGRESS", "ALL"})
        self._lines: JobLines | None = None

    def emit(self, record: LogRecord) -> None:
        """Print a message, whatever happens: an error here must never break a run, nor hide what Snakemake says."""
        if not self._is_ordinary:
            try:
                self._show(record)
                return
            except Exception as error:
                self._is_ordinary = True
                self._write(record, f"the display of progress failed ({error!r}); Snakemake's own follows")
        self._print_ordinarily(record)

    def close(self) -> None:
        """Say what came of the run."""
        lines, self._lines = self._lines, None
        if lines is not None and not self._is_ordinary:
            with suppress(Exception):
                for line in lines.end(os.environ.get(COMMAND, "")):
                    self._write(None, line)
        super().close()

    def _show(self, record: LogRecord) -> None:
        event = getattr(record, "event", None)
        values: dict[str, Any] = record.__dict__
        now = time.monotonic()
        if event == LogEvent.RUN_INFO and "stats" in values:
            self._lines = JobLines({rule: count for rule, count in values["stats"].items() if rule != "total"}, now)
        if self._lines is None:
            self._print_ordinarily(record)
        elif record.getMessage() == _CHATTER or event in _REPLACED:
            return
        elif event == LogEvent.JOB_INFO:
            job = Job(
                values["rule_name"],
                tuple(map(str, values["wildcards"].values())),
                tuple(map(str, values["output"])),
                tuple(map(str, values["log"])),
            )
            self._write(record, self._lines.start(values["jobid"], job, now))
        elif event == LogEvent.JOB_FINISHED and self._lines.is_running(values["job_id"]):
            self._write(record, self._lines.finish(values["job_id"], now))
        else:
            if event == LogEvent.JOB_ERROR and self._lines.is_running(values["jobid"]):
                self._write(record, self._lines.fail(values["jobid"], now))
            self._print_ordinarily(record)

    def _print_ordinarily(self, record: LogRecord) -> None:
        with suppress(Exception):
            self._erase_bar()
            self._ordinary.handle(record)

    def _write(self, record: LogRecord | None, line: str) -> None:
        """Write a line of ours, in the colour of the record."""
        if self._is_quiet:
            return
        stream = self._ordinary.stream
        with suppress(OSError, ValueError):  # a closed stream has nobody who reads
            encoding = getattr(stream, "encoding", None) or "utf-8"
            line = line.replace("·", "-") if not _can_encode(line, encoding) else line
            self._erase_bar()
            stream.write((line if record is None else self._ordinary.decorate(record, line)) + "\n")
            stream.flush()

    def _erase_bar(self) -> None:
        """Clear what is left of a job's progress bar in the terminal's last line; its next update draws it again."""
        if self._ordinary.is_tty:
            self._ordinary.stream.write(_ERASE_LINE)

    @property
    def writes_to_stream(self) -> bool:
        """It takes the place of Snakemake's own output."""
        return True

    @property
    def writes_to_file(self) -> bool:
        """Snakemake's log file stays."""
        return False

    @property
    def has_filter(self) -> bool:
        """It sees everything, and what it hands on goes through Snakemake's filter."""
        return True

    @property
    def has_formatter(self) -> bool:
        """The same holds for the format."""
        return True

    @property
    def needs_rulegraph(self) -> bool:
        """Counts of jobs are enough."""
        return False


def _can_encode(line: str, encoding: str) -> bool:
    try:
        line.encode(encoding)
    except UnicodeEncodeError:
        return False
    return True
