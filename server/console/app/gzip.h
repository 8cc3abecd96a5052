#pragma once

#include <string>
#include <string_view>

namespace tandem::console {

/// Returns a text compressed by gzip [RFC 1952]. @throws std::bad_alloc
[[nodiscard]] std::string gzip(std::string_view text);

}  // namespace tandem::console
