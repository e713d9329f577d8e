"""The compiled part of the search under its name of before, by which pickles know it."""

from earshot.core import Episodes, FrozenPolicy, World, environment_crc32

__all__ = ["Episodes", "FrozenPolicy", "World", "environment_crc32"]
