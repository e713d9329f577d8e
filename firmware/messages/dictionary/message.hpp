#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

#include "firmware/messages/dictionary/field.hpp"

namespace earshot::messages {

/// What there is to know of a message: kType, the name of its LCM type; kChannel, where it is told; kMeaning; kFields, its lines, in the
/// order in which they are told. All doors of a program are made of it.
template <class Message>
struct Described;

template <class Message>
concept IsDescribed = requires {
  Described<Message>::kFields;
};

/// Calls `take.template operator()<Line>()` with the type of each line of a message, in their order: what a program does with a message's
/// numbers needs no more, and a microcontroller has no words.
template <IsDescribed Message, class Take>
constexpr void for_each_line_type(Take&& take) {
  using Fields = std::remove_const_t<decltype(Described<Message>::kFields)>;
  [&]<std::size_t... kLines>(std::index_sequence<kLines...>) {
    (take.template operator()<std::tuple_element_t<kLines, Fields>>(), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<Fields>>{});
}

/// Calls `take(line)` with each line of a message, in their order.
template <IsDescribed Message, class Take>
constexpr void for_each_line(Take&& take) {
  std::apply([&](const auto&... lines) { (take(lines), ...); }, Described<Message>::kFields);
}

namespace detail {

template <class... Lists>
struct Joined;
template <class... Some>
struct Joined<Types<Some...>> {
  using Type = Types<Some...>;
};
template <class... Some, class... More, class... Lists>
struct Joined<Types<Some...>, Types<More...>, Lists...> : Joined<Types<Some..., More...>, Lists...> {};

template <class Fields>
struct ReachesOf;
template <class... Lines>
struct ReachesOf<std::tuple<Lines...>> : Joined<Types<>, typename Lines::Reaches...> {};

}  // namespace detail

/// Whether the lines of a message reach every member of it: a member that is added has its line, or this does not compile.
template <IsDescribed Message>
consteval bool covers_all_members() {
  using Fields = std::remove_const_t<decltype(Described<Message>::kFields)>;
  return reaches_all_members<Message>(typename detail::ReachesOf<Fields>::Type{});
}

}  // namespace earshot::messages
