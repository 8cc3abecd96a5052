#pragma once

#include <string>

#include "server/export/lerobot_meta.h"

namespace tandem::server {

/// Returns the data card (`README.md`) of a data set: its size, its features with their numbers, and what is not known.
[[nodiscard]] std::string lerobot_card(const LerobotDataset& set, const LerobotLayout& layout);

}  // namespace tandem::server
