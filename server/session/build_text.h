#pragma once

#include <string_view>

namespace tandem::server {

/// Version of the program, digest of the sources that decide what a session computes, compiler and processor: the same
/// text means that the same inputs give the same outputs, bit for bit.
[[nodiscard]] std::string_view build_text() noexcept;

}  // namespace tandem::server
