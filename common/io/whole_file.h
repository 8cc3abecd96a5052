#pragma once

#include <cstdint>
#include <expected>
#include <string>

namespace tandem::io {

/// Returns the contents of a file of at most `bytes_max` bytes, or an error: `FILE: reason`.
[[nodiscard]] std::expected<std::string, std::string> read_whole_file(const std::string& path,
                                                                      std::uintmax_t bytes_max);

}  // namespace tandem::io
