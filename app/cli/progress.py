"""The progress of long jobs on standard error: bars on a terminal, else a line per stage."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn


@contextmanager
def stage_bars() -> Iterator[Callable[[str, int, int], None]]:
    """Yield a callback (stage, done, total) that shows one bar or line per stage; a total of 0 means unknown."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield _stage_lines(console)
        return
    columns = TextColumn("{task.description:<18}"), BarColumn(), TextColumn("{task.completed:.0f}"), TimeElapsedColumn()
    with Progress(*columns, console=console) as bars:
        tasks: dict[str, TaskID] = {}

        def finish() -> None:
            for task in bars.tasks:
                if not task.finished:
                    total = task.total or 1
                    bars.update(task.id, total=total, completed=total)

        def show(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                finish()
                tasks[stage] = bars.add_task(stage, total=None)
            bars.update(tasks[stage], completed=done, total=total or None)

        yield show
        finish()


def _stage_lines(console: Console) -> Callable[[str, int, int], None]:
    """Return a callback that prints a line when a stage begins, with the seconds since the job began."""
    start, stages = time.monotonic(), set[str]()

    def show(stage: str, _done: int, _total: int) -> None:
        if stage not in stages:
            stages.add(stage)
            console.print(f"{time.monotonic() - start:7.1f} s  {stage}", markup=False, highlight=False, soft_wrap=True)

    return show
