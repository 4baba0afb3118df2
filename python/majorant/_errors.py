# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions, one for each exit code of the command.

Exceptions of a callback or a density are not among these: they end the run and are raised again unchanged. Ctrl-C
ends a run with KeyboardInterrupt.
"""


class Error(Exception):
    """The base of all exceptions of majorant. The message is one line with the error, the place and a remedy."""

    exit_code = 6  #: exit code of the command for the same error


class UsageError(Error, ValueError):
    """Invalid arguments, or a file that cannot be written."""

    exit_code = 1


class ReadError(Error):
    """A file that cannot be read. The message names the line and the reason."""

    exit_code = 2


class UnsupportedError(Error):
    """A mesh that this function does not handle. The message names the place, and a function that handles it."""

    exit_code = 3


class InfeasibleError(Error):
    """There is no valid start for these options, or no injective way to the target points."""

    exit_code = 3


class StoppedError(Error):
    """A limit was reached before the first valid map. Later limits return the best map; see its `status`."""

    exit_code = 5


class InvalidError(Error):
    """A result that could not be proven to be valid. It is not returned or written."""

    exit_code = 5


class InternalError(Error):
    """An error of majorant itself; please report it with the input."""

    exit_code = 6
