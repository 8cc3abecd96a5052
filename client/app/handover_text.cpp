#include <cmath>

#include "client/app/client_status.h"
#include "common/base/format.h"

namespace tandem::client {
namespace {

/// Name number `n` of the list, from 1; empty: there is none.
std::string name_of(const std::vector<std::string>& names, std::uint32_t n) { return n >= 1 && n <= names.size() ? names[n - 1] : ""; }

std::string giver(std::uint32_t by, const SeatSetup& setup) {
  if (by == wire::HandoverParties::kScene) return "the scene";
  const std::string name = by == wire::HandoverParties::kOperator ? "" : name_of(setup.masters, by);
  return name.empty() ? "an operator" : name;
}

}  // namespace

std::string handover_brief(const ClientStatus& s) {
  const bool comes = s.handover == wire::Handover::kComes;
  if (!comes && s.handover != wire::Handover::kGoes) return "";
  return std::string(comes ? "more" : "less") + format(" weight in %.0f ms", 10 * std::round(1e2 * s.handover_s));
}

std::string handover_text(const ClientStatus& s, const SeatSetup& setup) {
  if (s.handover == wire::Handover::kNone) return "";
  if (s.handover == wire::Handover::kCalledOff) return "hand-over called off: a link is too old";
  const wire::HandoverParties& p = s.handover_parties;
  const std::string tool_name = name_of(setup.tools, p.tool + 1), tool = tool_name.empty() ? "the tool" : "the tool " + tool_name;
  const std::string by = giver(p.by, setup), to = name_of(setup.masters, p.to), when = format(" in %.0f ms", 10 * std::round(1e2 * s.handover_s));
  if (to.empty()) return by + " shares " + tool + " anew" + when + format(": your part becomes %u %%", p.percent);
  const bool whole = p.percent >= 100;
  if (by == to) return by + (whole ? " takes " + tool + when : " takes more of " + tool + when + format(": %u %%", p.percent));
  return by + " gives " + (whole ? "" : format("%u %% of ", p.percent)) + tool + " to " + to + when;
}

}  // namespace tandem::client
