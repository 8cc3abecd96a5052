#include "netsim/scenario/shipped_scenarios.h"

#include <array>

namespace tandem::netsim {
namespace {

constexpr auto kScenarios = sorted_by_name(std::to_array<EmbeddedFile>({
#include "scenarios_embedded_data.inc"
}));

}  // namespace

std::span<const EmbeddedFile> shipped_scenarios() noexcept { return kScenarios; }

const EmbeddedFile* find_shipped_scenario(std::string_view name) noexcept { return find_file(kScenarios, name); }

}  // namespace tandem::netsim
