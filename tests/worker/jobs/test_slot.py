import os
import signal
import threading
import time

import pytest

from worker.jobs.environment import child_environment
from worker.jobs.errors import SlotError
from worker.jobs.heap import resident_bytes
from worker.jobs.slot import Slot


@pytest.fixture
def make_slot(tmp_path):
    made = []

    def make(module="trial_executor", memory_limit_bytes=1 << 30, **options):
        environment = child_environment(tmp_path, gl="osmesa", native_cpu=False)
        slot = Slot(module, environment, memory_limit_bytes=memory_limit_bytes, **options)
        made.append(slot)
        return slot

    yield make
    for slot in made:
        slot.close()
        slot.kill()


@pytest.fixture
def slot(make_slot):
    slot = make_slot()
    slot.start()
    return slot


@pytest.fixture
def ask(tmp_path):
    def ask(slot, limit=30.0, cancelled=None, report=None, **body):
        request = {"kind": "texture", "body": body, "digest": "d", "assets": "a"}
        return slot.run(
            request,
            tmp_path / "out",
            time_limit_seconds=limit,
            cancelled=cancelled,
            report=report,
        )

    return ask


def test_a_warm_child_answers_what_it_found(slot, ask, tmp_path):
    outcome = ask(slot, do="write", bytes=1000)
    assert outcome.status == "ok"
    assert outcome.facts == {"bytes": 1000}
    assert (tmp_path / "out").stat().st_size == 1000


def test_the_names_in_a_large_model_are_no_longer_than_an_answer_may_be(slot, ask):
    """Ten thousand nodes and as many materials may have names of 256 characters."""
    letters = 2 * 10_000 * 256
    outcome = ask(slot, do="say", letters=letters)
    assert outcome.status == "ok"
    assert len(outcome.facts["said"]) == letters


def test_starting_tells_what_warming_up_told(make_slot):
    assert make_slot().start() == {"fingerprint": "trial"}


def test_the_same_child_answers_again(slot, ask, tmp_path):
    note = tmp_path / "pids"
    for _ in range(3):
        ask(slot, do="nothing", note_pid=str(note))
    assert len(set(note.read_text().split())) == 1


def test_a_child_is_expendable_and_has_its_environment_before_its_executor(slot, ask):
    facts = ask(slot, do="describe", variables=["NUMBA_CPU_NAME", "OPENBLAS_NUM_THREADS"]).facts
    assert facts["environment"] == {"NUMBA_CPU_NAME": "x86-64-v3", "OPENBLAS_NUM_THREADS": "1"}
    assert facts["oom_score_adj"] == 900
    assert facts["stdout_is_stderr"]


def test_a_child_loads_neither_the_records_nor_the_main_module_of_its_parent(slot, ask):
    assert ask(slot, do="describe", variables=[]).facts["loaded"] == []


def test_errors_that_know_their_failure_cross_as_data(slot, ask):
    outcome = ask(slot, do="refuse")
    assert outcome.status == "failed"
    assert outcome.failure == {"code": "refused", "message": "no", "pointer": "/texture"}
    assert slot.is_alive()


@pytest.mark.parametrize("do", ["stumble", "not json"])
def test_other_errors_are_told_to_the_log_only(slot, ask, do):
    outcome = ask(slot, do=do)
    assert outcome.failure["code"] == "internal_error"
    assert "secret" not in outcome.failure["message"]
    assert slot.is_alive()


def test_a_full_disk_has_its_own_code(slot, ask):
    assert ask(slot, do="fill disk").failure["code"] == "storage_full"


def test_a_segmentation_fault_is_a_crash(slot, ask):
    outcome = ask(slot, do="segfault")
    assert outcome.status == "crashed"
    assert str(-signal.SIGSEGV) in outcome.failure["message"]
    assert not slot.is_alive()


def test_a_dead_idle_child_is_noticed(slot, ask, tmp_path):
    note = tmp_path / "pids"
    ask(slot, do="nothing", note_pid=str(note))
    os.kill(int(note.read_text()), signal.SIGKILL)
    assert ask(slot, do="nothing").status == "crashed"
    slot.start()
    assert ask(slot, do="nothing").status == "ok"


def test_a_stuck_native_call_with_all_signals_blocked_ends_at_its_limit(
    slot, ask, is_gone, tmp_path
):
    note = tmp_path / "pids"
    started = time.monotonic()
    outcome = ask(slot, limit=0.5, do="stuck", note_pid=str(note))
    assert outcome.status == "timed_out"
    assert outcome.failure["code"] == "timed_out"
    assert 0.5 <= time.monotonic() - started < 5
    assert is_gone(note.read_text().strip())


def test_a_stuck_native_call_can_be_cancelled(slot, ask, tmp_path):
    cancelled = threading.Event()
    threading.Timer(0.2, cancelled.set).start()
    assert ask(slot, cancelled=cancelled, do="stuck").status == "cancelled"
    assert not slot.is_alive()


def test_a_child_returns_what_a_job_left_unused(slot, ask, tmp_path, wait_until):
    note = tmp_path / "pids"
    ask(slot, do="nothing", note_pid=str(note))
    child = int(note.read_text())
    before = resident_bytes(child)
    ask(slot, do="holes", bytes=200_000_000)
    # After the answer, which nobody should wait for
    wait_until(lambda: resident_bytes(child) < before + 20e6, 10)


def test_memory_beyond_the_limit_ends_the_child(make_slot, ask):
    slot = make_slot(memory_limit_bytes=200 << 20)
    slot.start()
    outcome = ask(slot, do="hog")
    assert outcome.status == "memory_exceeded"
    assert outcome.failure["code"] == "memory_exceeded"
    assert not slot.is_alive()


def test_running_out_of_memory_by_itself_is_the_same(slot, ask):
    assert ask(slot, do="exhaust").status == "memory_exceeded"


def test_progress_arrives_in_order_before_the_answer(slot, ask):
    heard = []
    outcome = ask(slot, report=lambda progress, stage: heard.append(progress), do="flood")
    assert outcome.status == "ok"
    assert heard == [step / 2000 for step in range(2000)]


def test_a_listener_that_fails_takes_the_child_with_it(slot, ask):
    def fail(progress, stage):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        ask(slot, report=fail, do="flood")
    assert not slot.is_alive()


def test_a_child_that_cannot_be_warmed_up_says_why(make_slot):
    with pytest.raises(SlotError, match="cold_executor did not become warm"):
        make_slot("cold_executor").start()
    with pytest.raises(SlotError, match="no_such_executor did not become warm"):
        make_slot("no_such_executor").start()


def test_warming_up_has_its_limit(make_slot):
    with pytest.raises(SlotError, match="time limit"):
        make_slot(warm_limit_seconds=0).start()


def test_a_closed_slot_is_dead_and_stays_so(slot, ask):
    threading.Timer(0.2, slot.close).start()
    assert ask(slot, do="stuck").status == "crashed"
    with pytest.raises(SlotError, match="closed"):
        slot.start()
