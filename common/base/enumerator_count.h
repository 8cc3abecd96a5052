#pragma once

#include <cstddef>
#include <string_view>

namespace tandem {

/// Whether the value is that of an enumerator. The compiler writes the name of an enumerator, and a cast for any other
/// value of the type.
template <auto kValue>
[[nodiscard]] consteval bool is_enumerator() noexcept {
  return std::string_view{__PRETTY_FUNCTION__}.find("kValue = (") == std::string_view::npos;
}

/// Number of enumerators of an enumeration whose values count up from 0. A table that is checked against it fails to
/// compile when an enumerator is added. @pre the underlying type is fixed
template <class Enumeration, std::size_t kFrom = 0>
[[nodiscard]] consteval std::size_t enumerator_count() noexcept {
  if constexpr (is_enumerator<static_cast<Enumeration>(kFrom)>()) {
    return enumerator_count<Enumeration, kFrom + 1>();
  } else {
    return kFrom;
  }
}

}  // namespace tandem
