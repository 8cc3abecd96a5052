#include "netsim/scenario/shipped_scenarios.h"

#include <algorithm>
#include <vector>

namespace tandem::netsim {
namespace {

struct Embedded {
  std::string_view name, unused, text;
};
constexpr Embedded kEmbedded[] = {
#include "scenarios_embedded_data.inc"
};

std::vector<ShippedScenario> sorted() {
  std::vector<ShippedScenario> all;
  for (const Embedded& scenario : kEmbedded) all.push_back({scenario.name, scenario.text});
  std::ranges::sort(all, {}, &ShippedScenario::name);
  return all;
}

}  // namespace

std::span<const ShippedScenario> shipped_scenarios() noexcept {
  static const std::vector<ShippedScenario> all = sorted();
  return all;
}

const ShippedScenario* find_shipped_scenario(std::string_view name) noexcept {
  for (const ShippedScenario& scenario : shipped_scenarios())
    if (scenario.name == name) return &scenario;
  return nullptr;
}

}  // namespace tandem::netsim
