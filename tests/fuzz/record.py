"""Keep the counts of the last recorded runs, and write docs/fuzzing.md from them."""
from fuzz.guarded import Result
def record(result: Result) -> None:
    raise NotImplementedError
