#pragma once

#include <string_view>

namespace tandem::server {

/// The program of server/export/parquet/dist, compiled in by embed.cmake.
[[nodiscard]] std::string_view parquet_program() noexcept;

}  // namespace tandem::server
