"""Read the published pickles as data: the reader makes only records and arrays, and never runs anything.

A pickle is a program. `pickle.Unpickler` with an allow-list still allocates what a broken file claims (a memo
index of 2^28 is 2 GB) and holds all points of a scene at once, so this one reads the format itself: only the
operations that records, arrays and plain values need. Points stay in the file until they are read.
"""

import pickle
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from models.errors import DataError
from models.sources.kitti360pose.pickle_values import (
    ALLOWED_GLOBALS,
    RECORD_CLASSES,
    AllowedGlobal,
    PickledRecord,
    RefusedPickle,
    StoredArray,
    StoredBytes,
    StoredType,
    fill_array,
)

ADVICE = "the file is damaged or not of KITTI360Pose; download or prepare it again"
LAZY_BYTES = 1024  # longer byte strings stay in the file
MALFORMED_ERRORS = (struct.error, LookupError, TypeError, ValueError, OverflowError, MemoryError)


class DataUnpickler:
    """Reads one pickle of protocol 3 to 5 from a seekable file; makes records, arrays and plain values only."""

    def __init__(self, file: BinaryIO, size: int) -> None:
        self._file, self._size = file, size
        self._stack: list[Any] = []
        self._marks: list[int] = []
        self._memo: dict[int, Any] = {}

    def load(self) -> Any:
        """Return the value of the pickle; raise RefusedPickle, or one of MALFORMED_ERRORS if it is broken."""
        read, steps, stop = self._file.read, OPERATIONS, pickle.STOP
        while (code := read(1)) != stop:
            step = steps.get(code)
            if step is None:
                if not code:
                    raise EOFError
                raise RefusedPickle(f"has operation {code!r} at byte {self._file.tell() - 1}, which data does not need")
            step(self)
        return self._stack.pop()

    def push(self, value: Any) -> None:
        """Put a value on the stack."""
        self._stack.append(value)

    def read(self, size: int) -> bytes:
        """Return the next bytes; never allocates more than the file holds."""
        if size > LAZY_BYTES and size > self._size - self._file.tell():
            raise EOFError
        data = self._file.read(size)
        if len(data) != size:
            raise EOFError
        return data

    def unsigned(self, width: int) -> int:
        """Return the next number of `width` bytes."""
        return int.from_bytes(self.read(width), "little")

    def text(self, width: int) -> None:
        """Push a string whose length takes `width` bytes."""
        self.push(self.read(self.unsigned(width)).decode("utf-8", "surrogatepass"))

    def data(self, width: int) -> None:
        """Push a byte string whose length takes `width` bytes, or its place in the file."""
        size = self.unsigned(width)
        if size <= LAZY_BYTES:
            return self.push(self.read(size))
        offset = self._file.tell()
        if size > self._size - offset:
            raise EOFError
        self._file.seek(offset + size)
        return self.push(StoredBytes(offset, size))

    def pop_marked(self) -> list[Any]:
        """Pop the values above the last mark."""
        start = self._marks.pop()
        items = self._stack[start:]
        del self._stack[start:]
        return items

    def mark(self) -> None:
        """Mark the stack's height."""
        self._marks.append(len(self._stack))

    def push_tuple(self, count: int) -> None:
        """Replace the last values by one tuple."""
        items = tuple(self._stack.pop() for _ in range(count))
        self.push(items[::-1])

    def extend(self, items: list[Any]) -> None:
        """Add to the list on top."""
        if type(self._stack[-1]) is not list:
            raise RefusedPickle("appends to something other than a list")
        self._stack[-1].extend(items)

    def update(self, items: list[Any]) -> None:
        """Add keys and values to the dict on top."""
        if type(self._stack[-1]) is not dict or not all(type(key) is str for key in items[::2]):
            raise RefusedPickle("sets names in something other than a dict of names")
        self._stack[-1].update(zip(items[::2], items[1::2], strict=True))

    def memoize_at(self, index: int) -> None:
        """Store the value on top under an index."""
        self._memo[index] = self._stack[-1]

    def recall(self, index: int) -> None:
        """Push a stored value."""
        self.push(self._memo[index])

    def memoize(self) -> None:
        """Store the value on top under the next index."""
        self.memoize_at(len(self._memo))

    def protocol(self) -> None:
        """Check the protocol."""
        if (version := self.unsigned(1)) not in (3, 4, 5):
            raise RefusedPickle(f"has protocol {version}, not 3 to 5")

    def frame(self) -> None:
        """Check a frame's length; frames only say how much to read at once."""
        if self.unsigned(8) > self._size - self._file.tell():
            raise EOFError

    def line(self) -> str:
        """Return the next line."""
        return self._file.readline(256).decode("utf-8").removesuffix("\n")

    def push_global(self, module: Any, name: Any) -> None:
        """Push an allowed global; refuse every other by name."""
        allowed = ALLOWED_GLOBALS.get((module, name)) if type(module) is type(name) is str else None
        if allowed is None:
            global_name = f"{module}.{name}" if type(module) is type(name) is str else "an unnamed object"
            raise RefusedPickle(f"asks for {global_name[:80]!r}, which no record or array needs")
        self.push(allowed)

    def stack_global(self) -> None:
        """Push the allowed global named by the two strings on top."""
        name, module = self._stack.pop(), self._stack.pop()
        self.push_global(module, name)

    def reduce(self) -> None:
        """Call a global that only builds a stand-in."""
        arguments, function = self._stack.pop(), self._stack.pop()
        if not isinstance(function, AllowedGlobal) or function.call is None or type(arguments) is not tuple:
            raise RefusedPickle("calls something other than an array or scalar")
        self.push(function.call(*arguments))

    def new(self) -> None:
        """Push an empty record."""
        arguments, kind = self._stack.pop(), self._stack.pop()
        if (
            not isinstance(kind, AllowedGlobal)
            or kind.name not in RECORD_CLASSES
            or type(arguments) is not tuple
            or arguments
        ):
            raise RefusedPickle("makes something other than a record")
        self.push(PickledRecord(kind.name))

    def build(self) -> None:
        """Give the stand-in on top its state."""
        state, target = self._stack.pop(), self._stack[-1]
        if isinstance(target, PickledRecord) and type(state) is dict:
            target.fields = state
        elif isinstance(target, StoredArray) and type(state) is tuple and len(state) == 5:
            fill_array(target, *state[1:])
        elif isinstance(target, StoredType) and type(state) is tuple and state[1] in ("<", ">", "|", "="):
            target.order = state[1]
        else:
            raise RefusedPickle("sets the state of something other than a record or array")

    def integer(self, width: int) -> None:
        """Push a signed number of `width` bytes."""
        self.push(int.from_bytes(self.read(width), "little", signed=True))


Operation = Callable[[DataUnpickler], object]
OPERATIONS: dict[bytes, Operation] = {
    pickle.PROTO: DataUnpickler.protocol,
    pickle.FRAME: DataUnpickler.frame,
    pickle.MARK: DataUnpickler.mark,
    pickle.NONE: lambda p: p.push(None),
    pickle.NEWTRUE: lambda p: p.push(True),
    pickle.NEWFALSE: lambda p: p.push(False),
    pickle.BININT: lambda p: p.integer(4),
    pickle.BININT1: lambda p: p.push(p.unsigned(1)),
    pickle.BININT2: lambda p: p.push(p.unsigned(2)),
    pickle.LONG1: lambda p: p.integer(p.unsigned(1)),
    pickle.BINFLOAT: lambda p: p.push(struct.unpack(">d", p.read(8))[0]),
    pickle.SHORT_BINUNICODE: lambda p: p.text(1),
    pickle.BINUNICODE: lambda p: p.text(4),
    pickle.BINUNICODE8: lambda p: p.text(8),
    pickle.SHORT_BINBYTES: lambda p: p.data(1),
    pickle.BINBYTES: lambda p: p.data(4),
    pickle.BINBYTES8: lambda p: p.data(8),
    pickle.BYTEARRAY8: lambda p: p.data(8),
    pickle.EMPTY_LIST: lambda p: p.push([]),
    pickle.EMPTY_TUPLE: lambda p: p.push(()),
    pickle.EMPTY_DICT: lambda p: p.push({}),
    pickle.TUPLE: lambda p: p.push(tuple(p.pop_marked())),
    pickle.TUPLE1: lambda p: p.push_tuple(1),
    pickle.TUPLE2: lambda p: p.push_tuple(2),
    pickle.TUPLE3: lambda p: p.push_tuple(3),
    pickle.APPEND: lambda p: p.extend([p._stack.pop()]),
    pickle.APPENDS: lambda p: p.extend(p.pop_marked()),
    pickle.SETITEM: lambda p: p.update([p._stack.pop(), p._stack.pop()][::-1]),
    pickle.SETITEMS: lambda p: p.update(p.pop_marked()),
    pickle.MEMOIZE: DataUnpickler.memoize,
    pickle.BINPUT: lambda p: p.memoize_at(p.unsigned(1)),
    pickle.LONG_BINPUT: lambda p: p.memoize_at(p.unsigned(4)),
    pickle.BINGET: lambda p: p.recall(p.unsigned(1)),
    pickle.LONG_BINGET: lambda p: p.recall(p.unsigned(4)),
    pickle.GLOBAL: lambda p: p.push_global(p.line(), p.line()),
    pickle.STACK_GLOBAL: DataUnpickler.stack_global,
    pickle.REDUCE: DataUnpickler.reduce,
    pickle.NEWOBJ: DataUnpickler.new,
    pickle.BUILD: DataUnpickler.build,
}


def read_pickle(file: BinaryIO, path: Path) -> Any:
    """Return the value of an open pickle file; arrays keep their values in the file.

    Raise DataError if it is cut short, not a pickle, or asks for anything but records and arrays.
    """
    try:
        return DataUnpickler(file, path.stat().st_size).load()
    except RefusedPickle as error:
        raise DataError(f"{path}: the pickle {error}; nothing was run; {ADVICE}") from error
    except EOFError as error:
        raise DataError(f"{path}: the pickle is cut short; {ADVICE}") from error
    except MALFORMED_ERRORS as error:
        raise DataError(f"{path}: not a pickle, or a broken one ({type(error).__name__}); {ADVICE}") from error
