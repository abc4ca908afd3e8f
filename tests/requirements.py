"""What a machine may lack, and when that is a failure."""

import os
from typing import NoReturn

import pytest


def skip_or_fail(reason: str, requirement: str) -> NoReturn:
    """Skip the running test, or fail it where the environment sets the requirement to 1."""
    if os.environ.get(requirement) == "1":
        pytest.fail(f"{reason}, and {requirement}=1 was set", pytrace=False)
    pytest.skip(reason)
