"""What goes wrong. Data that makes no sense is a ValueError that names the element; memory that is
not enough is a MemoryError."""

from __future__ import annotations

import os
import re
import sys
from numbers import Real
from types import FrameType
from typing import Any, Callable, Mapping, Protocol, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ._results import Certificate

__all__ = ["Cancelled", "CertificateError", "Error", "FileError", "NotCertifiedError",
           "NotSolidError"]

_Made = TypeVar("_Made")


class Error(Exception):
    """What is raised by treeform alone."""


class FileError(Error, OSError):
    """A file that cannot be read or written. The message names the path, the line or byte, and the
    reason.

    Where the system gives the reason, `errno`, `strerror` and `filename` say it, and the error is
    also what Python raises for it: FileNotFoundError, PermissionError, IsADirectoryError, ... They
    are None where the reason is in the file.
    """

    _message: str

    def __str__(self) -> str:
        return str(self._message) if hasattr(self, "_message") else super().__str__()

    def __reduce__(self) -> tuple[Any, ...]:
        return file_error, (str(self), self.errno or 0, self.filename or "")


#: By the classes of Python.
_FILE_ERRORS: dict[type[OSError], type[FileError]] = {}


def file_error(message: str, errno: int = 0, filename: str = "") -> FileError:
    """The FileError for what the system says, which is also what Python raises for that."""
    if errno == 0:
        return FileError(message)
    kind = type(OSError(errno, ""))
    if kind not in _FILE_ERRORS:
        _FILE_ERRORS[kind] = FileError if kind is OSError else type(
            "FileError", (FileError, kind), {"__module__": FileError.__module__,
                                             "__doc__": FileError.__doc__})
    error = _FILE_ERRORS[kind](errno, os.strerror(errno), filename)
    error._message = message
    return error


class Cancelled(Error):
    """`progress` has returned False."""


class CertificateError(Error, ValueError):
    """A result that is not what was asked for.

    `certificate` says why. With `check=False`, the operation returns it with the result instead.
    """

    def __init__(self, certificate: Certificate, of_one: bool = False) -> None:
        message = certificate.message
        super().__init__(message.replace(" of operand a", "") if of_one else message)
        self.certificate = certificate
        self._of_one = of_one

    def __reduce__(self) -> tuple[type[CertificateError], tuple[Certificate, bool]]:
        return type(self), (self.certificate, self._of_one)


class NotSolidError(CertificateError):
    """A mesh does not bound a solid: its surface ends somewhere."""

    @property
    def edges(self) -> NDArray[np.float64]:
        """(n, 2, 3): the ends of the first 100 edges where the surface ends."""
        return self.certificate.open_edges

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(n, 2): the operand and the face at each of these edges."""
        return self.certificate.open_faces


class NotCertifiedError(CertificateError):
    """The coordinates of a result could not be certified."""

    @property
    def pairs(self) -> NDArray[np.uint32]:
        """(n, 2): the first 100 pairs of faces of the result that still meet."""
        return self.certificate.meeting


def require(certificate: Certificate, *also: str, of_one: bool = False) -> None:
    """Raises what `certificate` says, unless it is ok or its status is one of `also`. `of_one`: of
    a single mesh, which is no operand."""
    if certificate or certificate.status in also:
        return
    if certificate.status == "open_input":
        raise NotSolidError(certificate, of_one)
    raise NotCertifiedError(certificate, of_one)


class _Certified(Protocol):
    @property
    def certificate(self) -> Certificate: ...


_Result = TypeVar("_Result", bound=_Certified)


def checked(made: _Result, check: bool, of_one: bool = False) -> _Result:
    """A result; with `check`, raises what its certificate says."""
    if check:
        require(made.certificate, "sheet", of_one=of_one)
    return made


#: What annotations ask for, and how that is said.
_KINDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "float": (lambda value: isinstance(value, (float, np.floating))
              or isinstance(value, Real) and abs(value) < 2**1023, "a number"),
    "int": (lambda value: isinstance(value, (int, np.integer)) and bool(0 <= value < 2**64),
            "a whole number, not negative,"),
    "bool": (lambda value: isinstance(value, (bool, np.bool_)), "True or False"),
    "str": (lambda value: isinstance(value, str), "a word"),
    "tuple[float, float]": (lambda value: np.shape(value) == (2,), "a pair of numbers"),
}


def name_argument(error: TypeError) -> None:
    """Raises ValueError that names an argument which is not what its function's annotation asks
    for, where the extension has refused those it was called with."""
    frame: FrameType | None = sys._getframe(1)
    if not re.search("incompatible (function|constructor) arguments", str(error)):
        return
    while frame is not None and frame.f_globals.get("__name__", "").startswith("treeform."):
        name = frame.f_code.co_name
        function = getattr(type(frame.f_locals.get("self")), name, frame.f_globals.get(name))
        for argument, annotation in getattr(function, "__annotations__", {}).items():
            if argument == "return":
                continue
            is_one, wanted = _KINDS.get(annotation.removesuffix(" | None"), (None, ""))
            value = frame.f_locals.get(argument)
            if is_one is None or (value is None and annotation.endswith("None")) or is_one(value):
                continue
            raise ValueError(f"{argument}: {wanted} is needed, not {value!r}") from None
        frame = frame.f_back


def options(type: Callable[..., _Made], arguments: Mapping[str, Any], **others: Any) -> _Made:
    """Options of the extension: those of a function's arguments, its `locals()`, that have their
    names; `others` in place of them."""
    names = cast(Any, type).names
    named = {name: value for name, value in {**arguments, **others}.items() if name in names}
    try:
        return type(**named)
    except TypeError as error:
        name_argument(error)
        raise


def need(value: Any, name: str, kind: type) -> Any:
    """`value`, which has to be one of these."""
    if not isinstance(value, kind):
        raise ValueError(f"{name}: {kind.__name__} is needed, not {value!r}")
    return value
