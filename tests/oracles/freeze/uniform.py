"""Numbers that a test in C++ makes again."""


def uniform(stream: int, i: int) -> float:
    """In [0, 1), 16 bits: exact in a float."""
    x = (i * 2654435761 + stream * 40503 + 12345) % 2**32
    x ^= x >> 15
    x = x * 2246822519 % 2**32
    x ^= x >> 13
    return (x >> 16) / 65536.0
