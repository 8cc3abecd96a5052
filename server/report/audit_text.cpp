#include "server/report/audit_text.h"

#include "common/base/format.h"

namespace tandem::server {

std::string audit_text(const AuditEvent& e, const SceneSpec& scene) {
  std::string text = e.seat < scene.seats.size()           ? scene.seats[e.seat].name
                     : e.seat == AuditEvent::kTimeline     ? "timeline"
                     : e.seat == AuditEvent::kControlPlane ? "console"
                                                           : "session";
  if (e.masters > 0 && e.tool < scene.tools.size()) text += " " + scene.tools[e.tool].name;
  if (e.version > 0) text += format(" version %u", e.version);
  text += format(" tick %u", e.tick);
  for (std::size_t i = 0; i < e.masters && i < scene.seats.size(); ++i)
    text += format("%s %s %.3f to %.3f", i == 0 ? ":" : ",", scene.seats[i].name.c_str(), e.before[i], e.after[i]);
  if (e.party < scene.seats.size()) text += "; the link of " + scene.seats[e.party].name + " is stale";
  return text;
}

}  // namespace tandem::server
