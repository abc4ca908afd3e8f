"""What a slot's thread does when it is told to stop at the worst moment."""

from types import SimpleNamespace

from worker.jobs.slot_thread import SlotThread


class Untimely:
    """A slot that is abandoned while its thread looks whether it is alive."""

    is_warm = True

    def __init__(self):
        self.abandon = None
        self.closed = False

    def is_alive(self):
        self.abandon()
        return True

    def close(self):
        self.closed = True

    def kill(self):
        pass


def test_a_thread_that_is_abandoned_between_two_jobs_takes_no_more():
    taken = []

    def take():
        taken.append("work")

    line = SimpleNamespace(arrivals=0, take=take, wait=lambda seen, seconds: None)
    slot = Untimely()
    thread = SlotThread("slot", lambda: slot, SimpleNamespace(line=line), 9)
    slot.abandon = thread.abandon

    thread.run()

    assert taken == []
    assert slot.closed
