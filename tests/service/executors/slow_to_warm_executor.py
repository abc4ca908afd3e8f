"""Takes a minute to become warm."""

import time


def warm(report):
    time.sleep(60)
