"""Durations in words, for people who wait."""

from __future__ import annotations


def describe_seconds(seconds: float) -> str:
    """Return a duration as ``"0.4 s"``, ``"14 s"``, ``"3 min 12 s"``, or ``"2 h 05 min"``.

    Parameters
    ----------
    seconds
        The duration, at least 0.
    """
    if seconds < 0.95:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    minutes = round(seconds / 60)
    return f"{minutes // 60} h {minutes % 60:02d} min"


def describe_roughly(seconds: float) -> str:
    """Return an estimate with no more digits than it deserves: ``"about 14 min"``, or ``"less than 10 s"``.

    Parameters
    ----------
    seconds
        The estimate, at least 0.
    """
    if seconds < 10:
        return "less than 10 s"
    if seconds < 55:
        return f"about {10 * round(seconds / 10)} s"
    minutes = round(seconds / 60)
    if minutes < 60:
        return f"about {minutes} min"
    if minutes < 600:
        tens = round(minutes / 10)
        return f"about {tens // 6} h {tens % 6 * 10:02d} min"
    return f"about {round(minutes / 60)} h"
