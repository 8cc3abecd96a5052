#include "netsim/demo/run_numbers.h"

#include <algorithm>

namespace tandem::netsim::demo {

const std::array<RunPlan, kRuns>& run_plans() noexcept {
  static constexpr std::array<RunPlan, kRuns> kPlans{{
      {"seed_free_motion", "seed_free_motion", Task::kFreeMotion, Setting::kSeed, 18},
      {"free_motion", "free_motion", Task::kFreeMotion, Setting::kDefaults, 18},
      {"free_motion_bad", "free_motion", Task::kFreeMotion, Setting::kBadNetwork, 18},
      {"seed_contact", "seed_contact", Task::kContact, Setting::kSeed, 20},
      {"contact", "contact", Task::kContact, Setting::kDefaults, 20},
      {"contact_bad", "contact", Task::kContact, Setting::kBadNetwork, 20},
  }};
  return kPlans;
}

const RunPlan& run_plan(Task task, Setting setting) noexcept {
  return *std::ranges::find_if(run_plans(), [&](const RunPlan& p) { return p.task == task && p.setting == setting; });
}

std::string title_of(const RunPlan& plan) {
  constexpr std::array<const char*, kSettings> kNames{"the paper’s gains", "Tandem’s defaults",
                                                      "Tandem’s defaults on the bad network"};
  return std::string(plan.task == Task::kFreeMotion ? "Free motion, " : "Contact, ") +
         kNames[static_cast<std::size_t>(plan.setting)];
}

std::string network_text(Setting setting) {
  return setting == Setting::kBadNetwork ? "20 ms + 0–5 ms jitter, 5 % loss each way" : "none added";
}

const PhaseNumbers* ReportNumbers::phase(std::string_view name) const noexcept {
  const auto found = std::ranges::find(phases, name, &PhaseNumbers::name);
  return found == phases.end() ? nullptr : &*found;
}

}  // namespace tandem::netsim::demo
