"""What ends a command: bad usage or input."""


class UsageError(Exception):
    """The user asked for what cannot be done; the message is one clear sentence, and the exit status is 2."""
