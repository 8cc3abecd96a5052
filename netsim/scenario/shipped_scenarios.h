#pragma once

#include <span>
#include <string_view>

#include "proto/text/embedded_file.h"

namespace tandem::netsim {

/// All scenarios of netsim/scenario, sorted by name. They use shipped scenes and profiles only.
[[nodiscard]] std::span<const EmbeddedFile> shipped_scenarios() noexcept;

/// Returns the shipped scenario of that name, or null.
[[nodiscard]] const EmbeddedFile* find_shipped_scenario(std::string_view name) noexcept;

}  // namespace tandem::netsim
