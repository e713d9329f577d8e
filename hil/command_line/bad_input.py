"""What a person can put right: a command line, a file, a bus that is not there."""


class BadInput(ValueError):
    """Its text says what is wrong, and where."""
