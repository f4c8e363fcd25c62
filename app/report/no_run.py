"""The one way a report is refused."""


class NoRun(Exception):
    """The folder cannot be reported on; the message is one line."""
