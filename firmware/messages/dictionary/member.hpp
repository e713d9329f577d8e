#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace earshot::messages {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

namespace detail {

template <class Struct, class Value>
Value value_of(Value Struct::*);

template <class T>
struct WithoutOptional {
  using Type = T;
};
template <class T>
struct WithoutOptional<std::optional<T>> {
  using Type = T;
};

template <auto kStep>
struct Step {
  using Value = decltype(value_of(kStep));
};
template <auto... kSteps>
using Last = std::tuple_element_t<sizeof...(kSteps) - 1, std::tuple<Step<kSteps>...>>;

template <auto kStep, auto... kRest, class Owner>
constexpr auto* follow(Owner& owner) {
  auto& next = owner.*kStep;
  if constexpr (sizeof...(kRest) == 0) {
    return &next;
  } else if constexpr (kIsOptional<std::remove_cvref_t<decltype(next)>>) {
    return next ? follow<kRest...>(*next) : nullptr;
  } else {
    return follow<kRest...>(next);
  }
}

}  // namespace detail

/// A member of a message, by the way that leads to it: through members of members, and through what may be missing.
///
///   At<&Decision::belief, &BeliefSummary::spread>
template <auto... kSteps>
struct At {
  using Value = typename detail::Last<kSteps...>::Value;
  /// Null where something on the way is missing.
  template <class Message>
  [[nodiscard]] static constexpr auto* in(Message& message) {
    return detail::follow<kSteps...>(message);
  }
};
/// Where a way ends.
template <>
struct At<> {};

/// Some types, in their order.
template <class...>
struct Types {};

namespace detail {

/// Becomes whatever a member is made of. (Of a std::optional what is in it: else there would be two ways.)
struct Anything {
  template <class T>
  requires(!kIsOptional<T>) operator T() const;  // NOLINT(google-explicit-constructor): never called
};
template <std::size_t>
using AnythingAt = Anything;

template <class Struct, std::size_t... kIndices>
consteval bool is_made_of(std::index_sequence<kIndices...>) {
  return requires {
    Struct{AnythingAt<kIndices>{}...};
  };
}

}  // namespace detail

/// How many members a plain struct has: it is initialised by no more values than that.
template <class Struct, std::size_t kAtLeast = 1>
consteval std::size_t member_count() {
  if constexpr (!detail::is_made_of<Struct>(std::make_index_sequence<kAtLeast>{})) {
    return kAtLeast - 1;
  } else {
    return member_count<Struct, kAtLeast + 1>();
  }
}

namespace detail {

template <class Way>
struct Split;
template <auto kFirst, auto... kRest>
struct Split<At<kFirst, kRest...>> {
  using First = Step<kFirst>;
  using Rest = At<kRest...>;
};

/// How many different types these are. Counted by types: clang evaluates too few steps of a constant expression to search through values.
template <class Counted, class... Others>
struct Different;
template <class... Counted, class One, class... Others>
struct Different<Types<Counted...>, One, Others...>
    : Different<std::conditional_t<(std::is_same_v<Counted, One> || ...), Types<Counted...>, Types<Counted..., One>>, Others...> {};
template <class... Counted>
struct Different<Types<Counted...>> {
  static constexpr std::size_t kCount = sizeof...(Counted);
};

/// What is left of the ways that begin with a step, but for those that end with it.
template <class First, class Found, class... Ways>
struct Onwards {
  using Type = Found;
};
template <class First, class... Found, class One, class... Others>
struct Onwards<First, Types<Found...>, One, Others...> {
  static constexpr bool kGoesOn = std::is_same_v<typename Split<One>::First, First> && !std::is_same_v<typename Split<One>::Rest, At<>>;
  using Next = std::conditional_t<kGoesOn, Types<Found..., typename Split<One>::Rest>, Types<Found...>>;
  using Type = typename Onwards<First, Next, Others...>::Type;
};

template <class Struct, class Ways>
struct LeadEverywhere;

/// Whether the ways that begin with this step lead to all that is behind it.
template <class First, class Rest>
struct LeadOn : LeadEverywhere<typename WithoutOptional<typename First::Value>::Type, Rest> {};
template <class First>
struct LeadOn<First, Types<>> : std::true_type {};

template <class Struct, class... Ways>
struct LeadEverywhere<Struct, Types<Ways...>>
    : std::bool_constant<
          Different<Types<>, typename Split<Ways>::First...>::kCount == member_count<Struct>() &&
          (LeadOn<typename Split<Ways>::First, typename Onwards<typename Split<Ways>::First, Types<>, Ways...>::Type>::value && ...)> {};

}  // namespace detail

/// Whether these ways lead to every member of a struct, and to every member of each of its members that they lead into.
template <class Struct, class... Ways>
consteval bool reaches_all_members(Types<Ways...> /*ways*/) {
  return detail::LeadEverywhere<Struct, Types<Ways...>>::value;
}

}  // namespace earshot::messages
