"""The trial executor on a platform that gives other bytes."""

from trial_executor import run

__all__ = ["run", "warm"]


def warm(report):
    return {"fingerprint": "elsewhere"}
