"""All faults of a file in one text, of which a number in the environment chooses one when the program starts."""

from __future__ import annotations

from dataclasses import dataclass

from sites import CHECKS, Fault

# Where a constant is computed by the compiler every fault is off. EARSHOT_FAULTS_REACHED names a file of a byte a
# fault, set to 1 as a program comes by: it is mapped, so that what a child or a program that dies came by is kept too.
HEADER = """\
#pragma once
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
namespace earshot_faults {
struct State {
  int planted = 0;
  int count = 0;
  unsigned char* reached = nullptr;
  State() {
    if (const char* number = std::getenv("EARSHOT_FAULT")) planted = std::atoi(number);
    const char* name = std::getenv("EARSHOT_FAULTS_REACHED");
    if (name == nullptr) return;
    const int file = ::open(name, O_RDWR | O_CLOEXEC);
    struct stat about {};
    if (file < 0 || ::fstat(file, &about) != 0 || about.st_size == 0) return;
    void* bytes = ::mmap(nullptr, static_cast<unsigned long>(about.st_size),
                         PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (bytes == MAP_FAILED) return;
    count = static_cast<int>(about.st_size);
    reached = static_cast<unsigned char*>(bytes);
  }
};
inline State state __attribute__((init_priority(101)));
}  // namespace earshot_faults
constexpr bool earshot_fault(int number) {
  if (__builtin_is_constant_evaluated()) return false;
  if (number < earshot_faults::state.count) [[unlikely]] earshot_faults::state.reached[number] = 1;
  return earshot_faults::state.planted == number;
}
"""


@dataclass
class Switched:
    text: str
    lines: dict[int, int]  # line of `text` -> number of the fault that alone stands there


def switched(original: bytes, numbered: dict[int, Fault]) -> Switched:
    """The text with every fault behind its number, each on lines of its own, so that an error names it."""
    spans: dict[tuple[int, int], list[int]] = {}
    for number, fault in numbered.items():
        spans.setdefault((fault.start, fault.end), []).append(number)
    ordered = sorted(spans, key=lambda s: (s[0], -s[1]))
    writer = _Writer(original, numbered, spans, ordered)
    writer.put('#include "earshot_fault.hpp"\n')
    writer.region(0, len(original))
    return Switched("".join(writer.parts), writer.lines)


class _Writer:
    def __init__(
        self,
        original: bytes,
        numbered: dict[int, Fault],
        spans: dict[tuple[int, int], list[int]],
        ordered: list[tuple[int, int]],
    ) -> None:
        self.original, self.numbered, self.spans, self.ordered = original, numbered, spans, ordered
        self.next = 0
        self.parts: list[str] = []
        self.lines: dict[int, int] = {}
        self.line = 1

    def put(self, text: str, number: int | None = None) -> None:
        ends = text.count("\n")
        if number is not None:
            for line in range(self.line, self.line + ends + 1):
                self.lines[line] = number
        self.parts.append(text)
        self.line += ends

    def region(self, start: int, end: int) -> None:
        """The text from start to end, with the faults inside."""
        at = start
        while self.next < len(self.ordered) and self.ordered[self.next][0] < end:
            first, last = span = self.ordered[self.next]
            if first < at or last > end:  # half inside another: cannot be switched with it
                self.next += 1
                continue
            self.put(self.original[at:first].decode())
            self.next += 1
            self.one(span)
            at = last
        self.put(self.original[at:end].decode())

    def one(self, span: tuple[int, int]) -> None:
        numbers = self.spans[span]
        if span[0] == span[1]:
            for number in numbers:
                self.put("\n")
                self.put(f"if (earshot_fault({number})) {self.numbered[number].text}", number)
                self.put("\n")
            return
        left_out = [n for n in numbers if not self.numbered[n].text]
        others = [n for n in numbers if self.numbered[n].text]
        for number in left_out:
            self.put("\n")
            self.put(f"(earshot_fault({number}) ? void() : void(", number)
            self.put("\n")
        # A condition may be a pointer or an optional, which are of no type with true and false.
        is_condition = any(self.numbered[n].kind in CHECKS for n in others)
        cast = "static_cast<bool>" if is_condition else ""
        if others:
            self.put("\n(")
        for number in others:
            self.put("\n")
            self.put(f"earshot_fault({number}) ? {cast}({self.numbered[number].text}) :", number)
            self.put("\n")
        self.put(("(static_cast<bool>(" if is_condition else "(") if others else "")
        self.region(*span)
        self.put((")))" if is_condition else "))") if others else "")
        self.put("))" * len(left_out))
