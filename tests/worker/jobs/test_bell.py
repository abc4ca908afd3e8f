import asyncio
import threading

from worker.jobs.bell import Bell


def test_ringing_from_a_thread_wakes_those_who_listen_to_the_key():
    bell = Bell()

    async def listen():
        with bell.listening("a") as rung, bell.listening("b") as other:
            threading.Timer(0.05, bell.ring, ["a"]).start()
            async with asyncio.timeout(10):
                await rung.wait()
            assert not other.is_set()

    asyncio.run(listen())


def test_ringing_for_nobody_or_for_those_who_left_reaches_nobody():
    bell = Bell()

    async def leave():
        with bell.listening("a") as left:
            pass
        bell.ring("a")
        bell.ring("b")
        await asyncio.sleep(0)  # a ring would be delivered by the loop
        return left.is_set()

    assert asyncio.run(leave()) is False
