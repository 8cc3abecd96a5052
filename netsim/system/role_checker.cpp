#include "netsim/system/role_checker.h"

namespace tandem::netsim {

void check_role(const ObservedSeat& seat) {
  const wire::ForceMessage& force = seat.endpoint().tx;
  const bool observer = seat.spec().role == Role::kObserver && !seat.slave();
  if (observer && force.engage) seat.violated("observer_force");
  if (disengages_all(force.session) && force.engage) seat.violated("stop_engages_nobody");
  if (seat.client.seat() == nullptr || !seat.client.ran_in_tick()) return;
  if (observer && seat.force() > 0) seat.violated("observer_force");
  if (seat.core().requests().locally_stopped() && seat.core().gate().active()) seat.violated("own_stop");
}

void check_role(const server::AuditEvent& event, const SceneSpec& scene, double t, server::Violations& violations) {
  using What = server::AuditEvent::What;
  if (event.seat >= scene.seats.size()) return;
  const Role role = scene.seats[event.seat].role;
  const auto require = [&](bool permitted) {
    if (!permitted) violations.add("role", scene.seats[event.seat].name, t, false);
  };
  const bool instructor = role == Role::kInstructor;
  switch (event.what) {
    case What::kStop:
    case What::kResume:
    case What::kAllBack:
      return require(instructor);
    case What::kPause:
      return require(role == Role::kTrainee || role == Role::kEvaluator);
    case What::kAuthority:
      break;
    default:
      return;
  }
  if (instructor) return;
  require(role == Role::kTrainee && event.after[event.seat] <= event.before[event.seat] + 1e-9);
  for (std::size_t k = 0; k < scene.masters(); ++k)
    require(k == event.seat || scene.seats[k].role == Role::kInstructor ||
            std::abs(event.after[k] - event.before[k]) <= 1e-9);
}

}  // namespace tandem::netsim
