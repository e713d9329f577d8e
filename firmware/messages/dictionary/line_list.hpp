#pragma once

#include <cstddef>
#include <utility>

#include "firmware/messages/dictionary/member.hpp"

namespace earshot::messages {

namespace detail {

template <std::size_t kIndex, class Line>
struct NumberedLine {
  Line line;
};

template <class Indices, class... Each>
struct NumberedLines;
template <std::size_t... kIndices, class... Each>
struct NumberedLines<std::index_sequence<kIndices...>, Each...> : NumberedLine<kIndices, Each>... {
  explicit constexpr NumberedLines(const Each&... each) : NumberedLine<kIndices, Each>{each}... {}
};

}  // namespace detail

/// The lines of a message, in their order. Not a std::tuple: to choose among its constructors took a compiler half of its time, wherever
/// messages are read.
template <class... Each>
struct LineList : detail::NumberedLines<std::index_sequence_for<Each...>, Each...> {
  using Lines = Types<Each...>;
  explicit constexpr LineList(const Each&... each) : detail::NumberedLines<std::index_sequence_for<Each...>, Each...>(each...) {}
  static constexpr std::size_t kCount = sizeof...(Each);
};
template <class... Each>
LineList(Each...) -> LineList<Each...>;

namespace detail {

template <std::size_t... kIndices, class... Each, class Take>
constexpr void for_each_line(const NumberedLines<std::index_sequence<kIndices...>, Each...>& list, Take& take) {
  (take(static_cast<const NumberedLine<kIndices, Each>&>(list).line), ...);
}

template <std::size_t kIndex, class Line>
constexpr const Line& line_at(const NumberedLine<kIndex, Line>& numbered) {
  return numbered.line;
}

}  // namespace detail

/// The line with an index.
template <std::size_t kIndex, class... Each>
constexpr const auto& line_at(const LineList<Each...>& list) {
  return detail::line_at<kIndex>(list);
}

}  // namespace earshot::messages
