"""Run stages of the chain in a process of their own, which a fault can hit: ``chain_job.py FOLDER STAGE...``."""

import json
import sys
from pathlib import Path

from small_chain import run_stage

from morphoskel.logs import log_to

if __name__ == "__main__":
    folder = Path(sys.argv[1])
    log_to(folder / "job.log")
    for stage in sys.argv[2:]:
        run_stage(folder, json.loads((folder / "sections.json").read_text()), stage)
