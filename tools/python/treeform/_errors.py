"""The exceptions of the package. Invalid arguments raise ValueError, naming the element; running
out of memory raises MemoryError."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Protocol, TypeVar, cast

from ._arrays import Floats, Ids, expect
from ._results import Certificate

__all__ = ["Cancelled", "CertificateError", "Error", "FileError", "NotCertifiedError",
           "NotClosedError"]

_Made = TypeVar("_Made")


class Error(Exception):
    """Base of the exceptions that only treeform raises."""


class FileError(Error, OSError):
    """A file cannot be read or written. The message has the path, the line or byte, and the reason.

    If the operating system reported the error, it is also the Python exception for it, such as
    FileNotFoundError or PermissionError, with `errno`, `strerror` and `filename`. If the content of
    the file is the reason, these are None.
    """

    _message: str

    def __str__(self) -> str:
        return str(self._message) if hasattr(self, "_message") else super().__str__()

    def __reduce__(self) -> tuple[Any, ...]:
        return file_error, (str(self), self.errno or 0, self.filename or "")


#: By the exception that Python raises.
_FILE_ERRORS: dict[type[OSError], type[FileError]] = {}


def file_error(message: str, errno: int = 0, filename: str = "") -> FileError:
    """A FileError that is also the exception that Python raises for `errno`."""
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
    """`progress` returned False."""


class CertificateError(Error, ValueError):
    """A result does not have the guaranteed properties.

    `certificate` says why. With `check=False`, the operation returns the result with its
    certificate instead.
    """

    def __init__(self, certificate: Certificate, of: str = " of operand a") -> None:
        text, one = certificate.message, " of operand a"
        super().__init__(text.replace(one, of) if one in text or of == one else text + of)
        self.certificate = certificate
        self._of = of

    def __reduce__(self) -> tuple[type[CertificateError], tuple[Certificate, str]]:
        return type(self), (self.certificate, self._of)


class NotClosedError(CertificateError):
    """A mesh that must be closed is open."""

    @property
    def edges(self) -> Floats:
        """(n, 2, 3) the end points of the first 100 open edges."""
        return self.certificate.open_edges

    @property
    def faces(self) -> Ids:
        """(n, 2) the operand and the face at each of these edges."""
        return self.certificate.open_faces


class NotCertifiedError(CertificateError):
    """The coordinates of a result could not be certified."""

    @property
    def pairs(self) -> Ids:
        """(n, 2) the first 100 pairs of faces of the result that still intersect."""
        return self.certificate.meeting


def require(certificate: Certificate, *also: str, of: str = " of operand a") -> None:
    """Raises an error unless the status is ok, or one of `also`. `of` is the name of an only
    operand in the message."""
    if certificate or certificate.status in also:
        return
    if certificate.status == "open_input":
        raise NotClosedError(certificate, of)
    raise NotCertifiedError(certificate, of)


class _Certified(Protocol):
    @property
    def certificate(self) -> Certificate: ...


_Result = TypeVar("_Result", bound=_Certified)


def checked(made: _Result, check: bool, of: str = " of operand a") -> _Result:
    """A result, if its certificate is ok or `check` is False."""
    if check:
        require(made.certificate, "sheet", of=of)
    return made


def options(type: Callable[..., _Made], arguments: Mapping[str, Any], **others: Any) -> _Made:
    """Options of the extension: those arguments of a function (its `locals()`) that are options;
    `others` override them."""
    names = cast(Any, type).names
    return type(**{name: value for name, value in {**arguments, **others}.items()
                   if name in names})


def need(value: Any, name: str, kind: type) -> Any:
    """`value`, if it is of this class."""
    return expect(isinstance(value, kind), value, name, kind.__name__)
