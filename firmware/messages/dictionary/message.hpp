#pragma once

#include <type_traits>

#include "firmware/messages/dictionary/field.hpp"
#include "firmware/messages/dictionary/line_list.hpp"

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
  [&]<class... Each>(Types<Each...>) { (take.template operator()<Each>(), ...); }(typename Fields::Lines{});
}

/// Calls `take(line)` with each line of a message, in their order.
template <IsDescribed Message, class Take>
constexpr void for_each_line(Take&& take) {
  detail::for_each_line(Described<Message>::kFields, take);
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

template <class Lines>
struct ReachesOf;
template <class... Lines>
struct ReachesOf<Types<Lines...>> : Joined<Types<>, typename Lines::Reaches...> {};

}  // namespace detail

/// Whether the lines of a message reach every member of it: a member that is added has its line, or this does not compile.
template <IsDescribed Message>
consteval bool covers_all_members() {
  using Fields = std::remove_const_t<decltype(Described<Message>::kFields)>;
  return reaches_all_members<Message>(typename detail::ReachesOf<typename Fields::Lines>::Type{});
}

}  // namespace earshot::messages
