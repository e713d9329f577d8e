#pragma once

#include <concepts>

namespace earshot {

/// One function out of several, for std::visit. Without a generic one among them an alternative that none takes does not compile.
///
///   std::visit(Overloads{[](const Fix& fix) { ... }, Unheeded<Status, Report>{}}, value);
template <class... Functions>
struct Overloads : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloads(Functions...) -> Overloads<Functions...>;

/// Does nothing with any of these alternatives.
template <class... Alternatives>
struct Unheeded {
  template <class Alternative>
  requires(std::same_as<Alternative, Alternatives> || ...) constexpr void operator()(const Alternative& /*unheeded*/) const {}
};

}  // namespace earshot
