import subprocess
import sys

SCRIPT = """
import logging, sys, warnings
from morphoskel.logs import log_to
log_to(sys.argv[1])
logging.getLogger("morphoskel.stage").info("1/8 done")
warnings.warn("old data")
raise ValueError("no surface")
"""


def test_the_log_has_everything_and_the_screen_the_gist(tmp_path):
    done = subprocess.run([sys.executable, "-c", SCRIPT, str(tmp_path / "job.log")], capture_output=True, text=True)
    log = (tmp_path / "job.log").read_text()
    assert done.returncode == 1
    for text in ("1/8 done", "old data", "ValueError: no surface", "Traceback"):
        assert text in log
    assert "ValueError: no surface" in done.stderr
    assert "1/8 done" not in done.stderr
    assert "Traceback" not in done.stderr
