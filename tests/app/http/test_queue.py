import asyncio
import time
from contextlib import asynccontextmanager

import pytest

from app.http.errors import Code, Problem
from app.http.queue import InferenceQueue
from index.answering.query import Query


def ask(name):
    return Query(name)


def names(batch):
    return [query.description for query in batch]


def soon(seconds=5.0):
    return time.monotonic() + seconds


@asynccontextmanager
async def running(fake, max_queue=100):
    queue = InferenceQueue(lambda: [fake], max_queue)
    queue.start()
    while True:
        try:
            queue.check_accepting()
            break
        except Problem:
            await asyncio.sleep(0.005)
    try:
        yield queue
    finally:
        fake.gate.set()
        await queue.close()


async def submitted(queue, *jobs, deadline_s=None):
    """Tasks that wait in the queue, behind a first one that the model is busy with."""
    tasks = [asyncio.create_task(queue.submit(ask(job), deadline_s or soon())) for job in jobs]
    await asyncio.sleep(0.02)
    return tasks


async def busy(queue, fake):
    fake.gate.clear()
    [task] = await submitted(queue, "first")
    assert await asyncio.to_thread(fake.entered.acquire, timeout=60)
    return task


def test_what_waits_is_computed_in_its_order(fake):
    async def run():
        async with running(fake) as queue:
            first = await busy(queue, fake)
            rest = await submitted(queue, *"abcdef")
            fake.gate.set()
            await asyncio.gather(first, *rest)

    asyncio.run(run())
    assert [names(batch) for batch in fake.batches] == [["first"], *([name] for name in "abcdef")]


def test_each_gets_its_own_answer_and_its_wait(fake):
    async def run():
        async with running(fake) as queue:
            first = await busy(queue, fake)
            waiting = await submitted(queue, "a tree", "nowhere")
            fake.gate.set()
            return [await first, *await asyncio.gather(*waiting)]

    first, tree, nowhere = asyncio.run(run())
    assert [served.answer.status for served in (first, tree, nowhere)] == ["ok", "ok", "no_match"]
    assert tree.queue_ms > 15


def test_lone_query_is_not_kept_waiting(fake):
    async def run():
        async with running(fake) as queue:
            return await queue.submit(ask("a"), soon())

    assert asyncio.run(run()).queue_ms < 100


def test_bad_item_fails_alone(fake):
    async def run():
        async with running(fake) as queue:
            first = await busy(queue, fake)
            rest = await submitted(queue, "a", "bad", "c")
            fake.gate.set()
            await first
            return await asyncio.gather(*rest, return_exceptions=True)

    good, bad, also_good = asyncio.run(run())
    assert good.answer.status == also_good.answer.status == "ok"
    assert isinstance(bad, RuntimeError)
    assert [names(batch) for batch in fake.batches] == [["first"], ["a"], ["bad"], ["c"]]


def test_wrong_number_of_answers_is_a_fault(fake):
    fake._answer, one = None, fake._answer
    fake.localize = lambda queries: [one(queries[0])] * 2

    async def run():
        async with running(fake) as queue:
            await queue.submit(ask("a"), soon())

    with pytest.raises(ValueError, match="too many values"):
        asyncio.run(run())


def test_cancelled_is_not_computed_and_frees_its_place(fake):
    async def run():
        async with running(fake, max_queue=1) as queue:
            first = await busy(queue, fake)
            [gone] = await submitted(queue, "gone")
            gone.cancel()
            await asyncio.gather(gone, return_exceptions=True)
            [stays] = await submitted(queue, "stays")
            fake.gate.set()
            await asyncio.gather(first, stays)

    asyncio.run(run())
    assert [names(batch) for batch in fake.batches] == [["first"], ["stays"]]


def test_expired_is_answered_in_time_and_not_computed(fake):
    async def run():
        async with running(fake) as queue:
            first = await busy(queue, fake)
            started = time.monotonic()
            with pytest.raises(Problem) as raised:
                await queue.submit(ask("late"), soon(0.05))
            assert 0.04 < time.monotonic() - started < 1
            assert raised.value.code is Code.DEADLINE_EXCEEDED
            fake.gate.set()
            await first

    asyncio.run(run())
    assert [names(batch) for batch in fake.batches] == [["first"]]


def test_expired_is_not_computed_even_if_the_event_loop_is_late(fake):
    async def run():
        async with running(fake) as queue:
            first = await busy(queue, fake)
            [late] = await submitted(queue, "late", deadline_s=soon(0.05))
            time.sleep(0.1)  # the loop cannot cancel it now
            fake.gate.set()
            time.sleep(0.1)
            await asyncio.gather(first, late, return_exceptions=True)
            assert late.exception().code is Code.DEADLINE_EXCEEDED

    asyncio.run(run())
    assert [names(batch) for batch in fake.batches] == [["first"]]


def test_full_queue_refuses(fake):
    async def run():
        async with running(fake, max_queue=2) as queue:
            first = await busy(queue, fake)
            waiting = await submitted(queue, "a", "b")
            with pytest.raises(Problem) as raised:
                await queue.submit(ask("c"), soon())
            assert raised.value.code is Code.QUEUE_FULL
            assert queue.refusal() is not None
            queue.drain()
            assert queue.refusal() is None, "it is refused as the service ends, and not to be tried again here"
            fake.gate.set()
            await asyncio.gather(first, *waiting)

    asyncio.run(run())


def test_drain_answers_what_waits_and_refuses_what_is_new(fake):
    async def run():
        async with running(fake) as queue:
            assert queue.is_idle
            first = await busy(queue, fake)
            assert not queue.is_idle
            waiting = await submitted(queue, "a", "b")
            closing = asyncio.create_task(queue.close())
            await asyncio.sleep(0.02)
            with pytest.raises(Problem) as raised:
                await queue.submit(ask("new"), soon())
            assert raised.value.code is Code.DRAINING
            assert not closing.done()
            fake.gate.set()
            answers = await asyncio.gather(first, *waiting)
            await closing
            assert queue.is_idle
            return answers

    assert len(asyncio.run(run())) == 3
    assert sum(map(len, fake.batches)) == 3


def test_idle_queue_closes_at_once(fake):
    async def run():
        started = time.monotonic()
        async with running(fake):
            pass
        return time.monotonic() - started

    assert asyncio.run(run()) < 1


def test_what_would_wait_too_long_is_refused_at_the_door(fake):
    async def run():
        queue = InferenceQueue(lambda: [fake], 100, max_wait_s=0.5)
        queue.start()
        await queue.wait_until_open()
        for _ in range(200):
            queue._update_query_time(0.1)
        first = await busy(queue, fake)
        rest = await submitted(queue, *"abcdef", deadline_s=soon(60))
        await asyncio.sleep(0.3)  # a refusal takes its time
        refused = [task for task in rest if task.done()]
        assert len(refused) == 1
        with pytest.raises(Problem) as problem:
            await refused[0]
        assert problem.value.code is Code.QUEUE_FULL
        assert (problem.value.headers or {})["Retry-After"] == "1"
        fake.gate.set()
        await asyncio.gather(first, *(task for task in rest if task not in refused))
        assert (await queue.submit(ask("later"), soon(60))).answer.status == "ok"
        fake.gate.set()
        await queue.close()

    asyncio.run(run())


def test_a_deadline_that_the_wait_would_pass_is_refused_too(fake):
    async def run():
        async with running(fake) as queue:
            for _ in range(200):
                queue._update_query_time(0.1)
            first = await busy(queue, fake)
            waiting = await submitted(queue, *"abc")
            with pytest.raises(Problem) as problem:
                await queue.submit(ask("hurried"), soon(0.2))
            assert problem.value.code is Code.QUEUE_FULL
            fake.gate.set()
            await asyncio.gather(first, *waiting)

    asyncio.run(run())


def test_one_slow_query_shuts_no_door(fake):
    queue = InferenceQueue(lambda: [fake], 100)
    queue._update_query_time(60.0)
    assert queue._query_s < 0.1


def test_a_busy_worker_keeps_nothing_from_an_idle_one(fake):
    fakes = [fake, type(fake)()]

    async def run():
        queue = InferenceQueue(lambda: fakes, 100)
        queue.start()
        await queue.wait_until_open()
        assert queue.num_workers == 2
        for one in fakes:
            one.gate.clear()
        tasks = await submitted(queue, "first", "second")
        for one in fakes:
            assert await asyncio.to_thread(one.entered.acquire, timeout=60)
        rest = await submitted(queue, *"abcdef")
        fakes[0].gate.set()
        await asyncio.gather(*rest)
        fakes[1].gate.set()
        await asyncio.gather(*tasks)
        await queue.close()

    asyncio.run(run())
    assert [name for batch in fakes[0].batches[1:] for name in names(batch)] == [*"abcdef"]
    assert len(fakes[1].batches) == 1
    assert all(one.is_closed for one in fakes)


def test_of_idle_workers_the_first_is_asked(fake):
    workers = [fake, type(fake)(), type(fake)()]

    async def run():
        queue = InferenceQueue(lambda: workers, 100)
        queue.start()
        await queue.wait_until_open()
        for n in range(9):
            while len(queue._idle) < len(workers):
                await asyncio.sleep(0.001)
            await queue.submit(ask(str(n)), soon())
        await queue.close()

    asyncio.run(run())
    assert [len(worker.batches) for worker in workers] == [9, 0, 0]
