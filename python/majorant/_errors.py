# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions, one for each exit code of the command.

Exceptions that a callback or a density of yours raises are not among these: they end the run and come
back as they were. Ctrl-C ends it with KeyboardInterrupt.
"""


class Error(Exception):
    """The base of all exceptions of majorant. The message is one line with the error, the place and a remedy."""

    exit_code = 6  #: of the command, for the same


class UsageError(Error, ValueError):
    """Arguments that make no sense, or a file that cannot be written."""

    exit_code = 1


class ReadError(Error):
    """A file that cannot be read: which line, and why."""

    exit_code = 2


class UnsupportedError(Error):
    """A mesh that this function does not handle; the message names the place and one that does."""

    exit_code = 3


class InfeasibleError(Error):
    """There is no valid start for what was asked, or no valid way to the points that shall be met."""

    exit_code = 3


class StoppedError(Error):
    """A limit was reached before there was any map. (Later, the best map is returned: `status`.)"""

    exit_code = 5


class InvalidError(Error):
    """A result that could not be proven to be valid: it is not returned, or not written."""

    exit_code = 5


class InternalError(Error):
    """An error of majorant itself; please report it with the input."""

    exit_code = 6
