#include "server/console/evaluation_sheets.h"

#include <algorithm>
#include <array>

namespace tandem::console {
namespace {

constexpr std::array kOsats{"respect_for_tissue",       "time_and_motion",   "instrument_handling",
                            "knowledge_of_instruments", "use_of_assistants", "flow_and_forward_planning",
                            "knowledge_of_procedure"};
constexpr std::array kGears{"depth_perception",  "bimanual_dexterity", "efficiency",
                            "force_sensitivity", "robotic_control",    "autonomy"};
constexpr std::array kGoals{"depth_perception", "bimanual_dexterity", "efficiency", "tissue_handling", "autonomy"};
constexpr std::array kChecklist{"device_checked", "task_explained", "contact_gentle",
                                "target_reached", "no_force_limit", "hand_over_clear"};
constexpr std::array<SheetForm, 4> kForms{
    {{"OSATS", 1, 5, kOsats}, {"GEARS", 1, 5, kGears}, {"GOALS", 1, 5, kGoals}, {"CHECKLIST", 0, 1, kChecklist}}};

}  // namespace

const SheetForm* sheet_form(std::string_view name) noexcept {
  const auto found = std::ranges::find(kForms, name, &SheetForm::name);
  return found == kForms.end() ? nullptr : &*found;
}

std::expected<void, std::string> check(const EvaluationSheet& sheet) {
  const SheetForm* const form = sheet_form(sheet.form);
  if (form == nullptr) return std::unexpected("\"sheet\" must be OSATS, GEARS, GOALS or CHECKLIST");
  for (const auto& [item, points] : sheet.scores) {
    if (std::ranges::find(form->items, item, [](const char* known) { return std::string_view(known); }) ==
        form->items.end())
      return std::unexpected("\"scores\": " + sheet.form + " has no item \"" + item + "\"");
    if (points < form->least || points > form->most)
      return std::unexpected("\"scores\": \"" + item + "\" must be an integer in [" + std::to_string(form->least) +
                             ", " + std::to_string(form->most) + "]");
  }
  return {};
}

}  // namespace tandem::console
