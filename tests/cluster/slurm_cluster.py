"""A SLURM cluster of one node on this machine, for as long as a test needs it.

It needs the programs of Debian's packages ``munge``, ``slurmctld``, ``slurmd`` and ``slurm-client`` (see
``install_slurm``); no accounting, no cgroups, no systemd. Everything it writes is in one folder, so that neither
``/etc/slurm`` nor a cluster that this machine belongs to is touched; ``SLURM_CONF`` tells the commands where to look.

Run a command in such a cluster, here a shell:  python tests/cluster/slurm_cluster.py bash
"""

from __future__ import annotations

import os
import pwd
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "srun")
"""What is started and called here."""

START_SECONDS = 60.0
"""How long a daemon may take to start, on a busy machine."""

CONFIGURATION = """\
ClusterName=morphoskel
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
MailProg=/bin/true
ReturnToService=2
# No cgroups; but a job whose processes grow beyond the memory that it asked for is killed, as on a real cluster.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=2
JobAcctGatherParams=UsePss,OverMemoryKill
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
# Many short jobs: look for the next one often.
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=2,max_rpc_cnt=0
KillWait=5
# Memory is promised rather than counted, so that jobs that ask for much and need little run on a small machine, too.
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory={memory} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing_programs() -> list[str]:
    """Return the programs of SLURM and MUNGE that this machine lacks."""
    return [name for name in PROGRAMS if _find(name) is None]


@contextmanager
def slurm_cluster(processors: int = 2, memory: int = 32_000) -> Iterator[dict[str, str]]:
    """Run a cluster of one node, and stop it and its jobs at the end, also after an exception or Ctrl-C.

    Parameters
    ----------
    processors
        That the node has to offer.
    memory
        That it has to offer, in MB.

    Yields
    ------
    dict
        The variables, ``PATH`` among them, of an environment in which SLURM's commands speak to this cluster.

    Raises
    ------
    RuntimeError
        If a program is missing or a daemon does not start; with the end of its log.
    """
    missing = missing_programs()
    if missing:
        raise RuntimeError(f"{', '.join(missing)}: not on this machine; run tests/cluster/install_slurm")
    # A job's processes may not be children of this one, so a termination must unwind the stack like Ctrl-C.
    previous = signal.signal(signal.SIGTERM, _interrupt)
    try:
        with ExitStack() as stack:
            # MUNGE wants every folder above its socket to be writable by its owner alone, or sticky.
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp")))
            folder.chmod(0o755)
            search_path = f"{folder}/bin:{os.environ.get('PATH', os.defpath)}"
            variables = {"SLURM_CONF": f"{folder}/slurm.conf", "PATH": search_path}
            environment = {**os.environ, **variables}
            _write_configuration(folder, processors, memory)
            _write_srun(folder)
            stack.enter_context(_munge(folder))
            stack.enter_context(_daemon(folder, "slurmctld", environment))
            stack.enter_context(_daemon(folder, "slurmd", environment))
            _wait_until(lambda: _node_is_idle(environment), "the node to be idle", folder / "slurmctld.log")
            stack.callback(_cancel_everything, environment)
            yield variables
    finally:
        signal.signal(signal.SIGTERM, previous)


def _write_configuration(folder: Path, processors: int, memory: int) -> None:
    for name in ("state", "spool"):
        (folder / name).mkdir()
    text = CONFIGURATION.format(
        folder=folder,
        host=socket.gethostname().split(".")[0],
        user=pwd.getpwuid(os.getuid()).pw_name,
        controller_port=_free_port(),
        node_port=_free_port(),
        processors=processors,
        memory=memory,
    )
    (folder / "slurm.conf").write_text(text, encoding="utf-8")


def _write_srun(folder: Path) -> None:
    """Put a ``srun`` into the search path that knows where the configuration is.

    Inside a job, the executor plugin calls it without any variable of SLURM but those that it knows.
    """
    program = folder / "bin" / "srun"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nSLURM_CONF={folder}/slurm.conf exec {_find("srun")} "$@"\n', encoding="utf-8")
    program.chmod(0o755)


@contextmanager
def _munge(folder: Path) -> Iterator[None]:
    """Run the service by which SLURM's programs know each other, with a key of its own."""
    key = folder / "munge.key"
    key.touch(mode=0o600)
    key.write_bytes(os.urandom(1024))
    command = [
        str(_find("munged")),
        "--foreground",
        f"--key-file={key}",
        f"--socket={folder}/munge.socket",
        f"--pid-file={folder}/munged.pid",
        f"--seed-file={folder}/munged.seed",
        f"--log-file={folder}/munged.log",
    ]
    with _running(command, folder / "munged.output"):
        _wait_until((folder / "munge.socket").exists, "munged to start", folder / "munged.output")
        yield


@contextmanager
def _daemon(folder: Path, name: str, environment: dict[str, str]) -> Iterator[None]:
    with _running([str(_find(name)), "-D", "-f", environment["SLURM_CONF"]], folder / f"{name}.output", environment):
        yield


@contextmanager
def _running(command: Sequence[str], output: Path, environment: dict[str, str] | None = None) -> Iterator[None]:
    """Run a program beside this one, in a session of its own, so that Ctrl-C reaches it through us alone."""
    with output.open("w") as stream:
        process = subprocess.Popen(
            command, stdout=stream, stderr=subprocess.STDOUT, env=environment, start_new_session=True
        )
        try:
            yield
        finally:
            process.terminate()
            try:
                process.wait(timeout=15)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _node_is_idle(environment: dict[str, str]) -> bool:
    asked = subprocess.run(
        ["sinfo", "--noheader", "--format=%T"], env=environment, capture_output=True, text=True, check=False
    )
    return asked.stdout.strip() == "idle"


def _cancel_everything(environment: dict[str, str]) -> None:
    """Cancel all jobs and wait until their processes are gone."""
    user = pwd.getpwuid(os.getuid()).pw_name
    subprocess.run(["scancel", f"--user={user}"], env=environment, check=False)

    def none_left() -> bool:
        asked = subprocess.run(["squeue", "--noheader"], env=environment, capture_output=True, text=True, check=False)
        return asked.returncode == 0 and not asked.stdout.strip()

    _wait_until(none_left, "the jobs to end", Path(environment["SLURM_CONF"]).with_name("slurmctld.log"))


def _wait_until(condition: Callable[[], bool], what: str, log: Path) -> None:
    deadline = time.monotonic() + START_SECONDS
    while not condition():
        if time.monotonic() > deadline:
            end = log.read_text(errors="replace")[-3000:] if log.exists() else ""
            raise RuntimeError(f"waited {START_SECONDS:.0f} s in vain for {what}; the end of {log}:\n{end}")
        time.sleep(0.2)


def _find(program: str) -> str | None:
    """Return where a program is; daemons are outside the search path of ordinary users."""
    return shutil.which(program, path=f"{os.environ.get('PATH', os.defpath)}:/usr/sbin:/sbin:/usr/local/sbin")


def _free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])


def _interrupt(number: int, frame: object) -> None:
    raise KeyboardInterrupt


if __name__ == "__main__":
    with slurm_cluster() as granted:
        sys.exit(subprocess.run(sys.argv[1:] or ["bash"], env={**os.environ, **granted}, check=False).returncode)
