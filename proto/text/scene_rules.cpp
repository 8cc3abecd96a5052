#include "proto/text/scene_rules.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/base/stiffness_limit.h"
#include "common/base/suggestions.h"
#include "proto/text/scene_convert.h"
#include "proto/text/scene_text.h"

namespace tandem::rules {
namespace {

using text::child_path;
using text::MessageValidator;
using text::number_text;

/// Tolerance of the sum of a row. Users who write 0.333333 must write 0.333334 for the third value.
constexpr double kSumTolerance = 1e-9;

std::string quoted(const std::string& name) { return '"' + name + '"'; }

/// Index of the first element named `name`.
template <class Things>
std::optional<std::size_t> find(const Things& things, const std::string& name) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name == name) return i;
  }
  return {};
}
template <class Things>
std::optional<std::size_t> resolve(const Things& things, const std::string& name, const char* kind,
                                   const std::string& path, MessageValidator& validator) {
  const auto index = find(things, name);
  if (!index && validator.is_set(path)) {
    std::vector<std::string> names;
    for (const auto& thing : things) names.push_back(thing.name);
    validator.error(path, std::string("no ") + kind + " has this name; " + suggest(name, names));
  }
  return index;
}

bool may_lead(const SeatSpec& seat) {
  return seat.kind == SeatKind::kMaster && seat.role != Role::kEvaluator && seat.role != Role::kObserver;
}

/// Authority rows from a flat list, one per named tool.
std::vector<AuthorityRow> read_rows(const google::protobuf::RepeatedPtrField<pb::Authority>& in,
                                    const std::string& path, MessageValidator& validator, const SceneSpec& scene) {
  struct Sum {
    bool named = false, whole = true;
    double sum = 0;
    std::string first_path, terms;
    std::array<bool, kSeatsMax> seen{};
    AuthorityRow row;
  };
  std::vector<Sum> sums(scene.tools.size());
  for (int i = 0; i < in.size(); ++i) {
    const auto& entry = in[i];
    const std::string here = child_path(path, "authority", i);
    const auto tool = resolve(scene.tools, entry.tool(), "tool", child_path(here, "tool"), validator);
    const auto seat = resolve(scene.seats, entry.seat(), "seat", child_path(here, "seat"), validator);
    if (!tool) continue;
    auto& sum = sums[*tool];
    if (!sum.named) sum.first_path = child_path(here, "alpha");
    sum.named = true;
    sum.sum += entry.alpha();
    sum.terms += (sum.terms.empty() ? "" : " + ") + entry.seat() + " " + number_text(entry.alpha());
    if (!seat || *seat >= kSeatsMax || !entry.has_alpha()) {
      sum.whole = false;  // already reported; an error of the sum would only be a consequence
      continue;
    }
    const auto& who = scene.seats[*seat];
    if (who.kind == SeatKind::kSlave) {
      validator.error(child_path(here, "seat"), "is a SLAVE seat; only masters have authority");
    } else if (entry.alpha() > 0 && !may_lead(who)) {
      validator.error(
          child_path(here, "alpha"),
          "an " + std::string(who.role == Role::kEvaluator ? "EVALUATOR" : "OBSERVER") + " never has authority");
    }
    if (sum.seen[*seat])
      validator.error(child_path(here, "seat"), "has authority over this tool already, a few lines above");
    sum.seen[*seat] = true;
    sum.row.tool = *tool;
    sum.row.alpha[*seat] = entry.alpha();
  }
  std::vector<AuthorityRow> rows;
  for (std::size_t tool = 0; tool < sums.size(); ++tool) {
    const auto& sum = sums[tool];
    if (!sum.named) continue;
    if (sum.whole && !(std::abs(sum.sum - 1) <= kSumTolerance)) {
      validator.error(sum.first_path, "the authorities over tool " + quoted(scene.tools[tool].name) + " sum to " +
                                          number_text(sum.sum) + " (" + sum.terms + "); they must sum to 1");
    }
    if (sum.whole) rows.push_back(sum.row);
  }
  return rows;
}

void read_tool(const pb::Tool& in, const std::string& path, MessageValidator& validator, std::size_t dof,
               ToolSpec& out) {
  out.name = in.name();
  if (in.has_k_s_n_m()) out.k_s = in.k_s_n_m();
  if (in.has_b_s_n_s_m()) out.b_s = in.b_s_n_s_m();
  if (in.has_contacts()) out.contacts = static_cast<ContactsMode>(in.contacts());
  if (in.has_contacts() && in.has_slave())
    validator.error(
        child_path(path, "contacts"),
        "is for tools that a SLAVE seat serves; the surfaces of this one are those of slave { environment { } }");
  // Without a slave the tool needs a SLAVE seat; read_seats_and_tools reports a tool without either.
  out.is_virtual = in.has_slave() && (!in.slave().has_model() || in.slave().model() == pb::VIRTUAL);
  out.m_s = in.has_m_s_kg() ? in.m_s_kg() : out.is_virtual ? kVirtualToolMass : kDeviceToolMass;
  if (out.is_virtual)
    return read_virtual_slave(in.slave(), dof, child_path(path, "slave"), validator, out.slave.start, out.environment);
  if (in.has_slave()) read_slave(in.slave(), dof, child_path(path, "slave"), validator, out.slave, out.environment);
}

/// Names must be unique: they are column headers of traces and command-line arguments.
void check_names(const pb::Scene& in, MessageValidator& validator) {
  std::vector<std::pair<std::string, std::string>> known;  // name, path
  const auto add = [&](const std::string& name, const std::string& path) {
    if (name.empty()) return;
    const auto same = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.first == name; });
    if (same != known.end())
      validator.error(path, "this name is taken by " + same->second + "; seats and tools need names of their own");
    known.emplace_back(name, path);
  };
  for (int i = 0; i < in.seat_size(); ++i) add(in.seat(i).name(), child_path(child_path("", "seat", i), "name"));
  for (int i = 0; i < in.tool_size(); ++i) add(in.tool(i).name(), child_path(child_path("", "tool", i), "name"));
}

}  // namespace

void read_seats_and_tools(const pb::Scene& in, MessageValidator& validator, SceneSpec& out) {
  if (in.seat_size() == 0) validator.error("seat", "a scene needs at least one seat");
  if (in.tool_size() == 0) validator.error("tool", "a scene needs at least one tool");
  check_names(in, validator);
  for (int i = 0; i < in.tool_size(); ++i) {
    read_tool(in.tool(i), child_path("", "tool", i), validator, out.dof, out.tools.emplace_back());
  }
  std::size_t masters = 0;
  for (const auto kind : {pb::Seat::MASTER, pb::Seat::SLAVE}) {
    for (int i = 0; i < in.seat_size(); ++i) {
      if (in.seat(i).kind() != kind) continue;
      const std::string path = child_path("", "seat", i);
      if (kind == pb::Seat::MASTER && ++masters == kMastersMax + 1) {
        validator.error(path, "at most " + std::to_string(kMastersMax) + " MASTER seats are allowed");
      }
      read_seat(in.seat(i), out.dof, path, validator, out.seats.emplace_back());
    }
  }
  if (masters == 0 && in.seat_size() > 0) validator.error("seat", "a scene needs at least one MASTER seat");

  std::vector<int> server(out.tools.size(), -1);  // file index of the SLAVE seat of a tool
  for (int i = 0, slave = static_cast<int>(masters); i < in.seat_size(); ++i) {
    if (in.seat(i).kind() != pb::Seat::SLAVE) continue;
    const auto index = static_cast<std::size_t>(slave++);
    const std::string path = child_path("", "seat", i);
    if (!in.seat(i).has_tool()) {
      validator.error(child_path(path, "tool"), "is missing: a SLAVE seat serves a tool");
      continue;
    }
    const auto tool = resolve(out.tools, in.seat(i).tool(), "tool", child_path(path, "tool"), validator);
    if (!tool) continue;
    if (server[*tool] >= 0) {
      validator.error(child_path(path, "tool"), "is served by " + child_path("", "seat", server[*tool]) + " already");
    } else if (in.tool(static_cast<int>(*tool)).has_slave()) {
      validator.error(child_path(path, "tool"), "has a slave of its own; take tool { slave { } } or this seat away");
    }
    server[*tool] = i;
    out.seats[index].tool = *tool;
    auto& spec = out.tools[*tool];
    spec.remote = true;
    spec.seat = index;
    spec.slave = out.seats[index].device;
    spec.environment = out.seats[index].environment;
  }
  for (std::size_t t = 0; t < out.tools.size(); ++t) {
    const auto& tool = in.tool(static_cast<int>(t));
    if (!tool.has_slave() && server[t] < 0) {
      validator.error(
          child_path("", "tool", static_cast<int>(t)),
          "nothing serves this tool; add slave { } to it, or a seat { kind: SLAVE tool: " + quoted(tool.name()) + " }");
    }
  }
}

void read_authority(const pb::Scene& in, MessageValidator& validator, SceneSpec& out) {
  out.authority = read_rows(in.authority(), "", validator, out);
  for (std::size_t t = 0; t < out.tools.size(); ++t) {
    const bool named = std::any_of(in.authority().begin(), in.authority().end(),
                                   [&](const auto& a) { return a.tool() == out.tools[t].name; });
    if (!named && !out.tools[t].name.empty()) {
      validator.error(child_path("", "tool", static_cast<int>(t)),
                      "no seat has authority over it; add authority { tool: " + quoted(out.tools[t].name) +
                          " seat: ... alpha: 1 }");
    }
  }
  for (int i = 0; i < in.timeline_size(); ++i) {
    const auto& step = in.timeline(i);
    const std::string path = child_path("", "timeline", i);
    if (step.authority_size() == 0) validator.error(path, "changes nothing; add authority { }");
    if (i > 0 && !(step.at_s() > in.timeline(i - 1).at_s())) {
      validator.error(child_path(path, "at_s"),
                      "the timeline must ascend; before it comes " + number_text(in.timeline(i - 1).at_s()));
    }
    if (step.at_s() >= out.duration) {
      validator.error(child_path(path, "at_s"), "must be before the end, duration_s = " + number_text(out.duration));
    }
    for (const auto& row : read_rows(step.authority(), path, validator, out))
      out.timeline.push_back({step.at_s(), row});
  }
}

void read_follow(const pb::Scene& in, MessageValidator& validator, SceneSpec& out) {
  const std::size_t seats = std::min(out.seats.size(), kSeatsMax);
  const std::size_t tools = std::min(out.tools.size(), kToolsMax);
  std::array<std::string, kSeatsMax> first_path;
  std::array<bool, kSeatsMax> whole{};
  whole.fill(true);
  for (int i = 0; i < in.follow_size(); ++i) {
    const auto& entry = in.follow(i);
    const std::string path = child_path("", "follow", i);
    const auto seat = resolve(out.seats, entry.seat(), "seat", child_path(path, "seat"), validator);
    const auto tool = resolve(out.tools, entry.tool(), "tool", child_path(path, "tool"), validator);
    if (!seat || *seat >= seats) continue;
    if (out.seats[*seat].kind == SeatKind::kSlave)
      validator.error(child_path(path, "seat"), "is a SLAVE seat; masters follow");
    if (first_path[*seat].empty()) first_path[*seat] = child_path(path, "weight");
    if (!tool || *tool >= tools || !entry.has_weight()) {
      whole[*seat] = false;
      continue;
    }
    out.follow[*seat][*tool] += entry.weight();
  }
  for (std::size_t s = 0; s < seats; ++s) {
    if (out.seats[s].kind != SeatKind::kMaster) continue;
    if (first_path[s].empty()) {
      const auto has = [&](std::size_t tool) {
        const auto over = [&](const AuthorityRow& row) { return row.tool == tool && row.alpha[s] > 0; };
        return std::any_of(out.authority.begin(), out.authority.end(), over) ||
               std::any_of(out.timeline.begin(), out.timeline.end(), [&](const auto& step) { return over(step.row); });
      };
      std::size_t tool = 0;
      while (tool < tools && !has(tool)) ++tool;
      out.follow[s][tool < tools ? tool : 0] = 1;
      continue;
    }
    double sum = 0;
    for (const double weight : out.follow[s]) sum += weight;
    if (whole[s] && !(std::abs(sum - 1) <= kSumTolerance)) {
      validator.error(first_path[s], "weights of seat " + quoted(out.seats[s].name) + " sum to " + number_text(sum) +
                                         "; they must sum to 1");
    }
  }
}

void read_phases(const pb::Scene& in, MessageValidator& validator, SceneSpec& out) {
  for (int i = 0; i < in.phase_size(); ++i) {
    const auto& phase = in.phase(i);
    const std::string path = child_path("", "phase", i);
    if (find(out.phases, phase.name())) validator.error(child_path(path, "name"), "another phase has this name");
    if (phase.has_from_s() && phase.has_to_s() && !(phase.to_s() > phase.from_s())) {
      validator.error(child_path(path, "to_s"), "must be after from_s = " + number_text(phase.from_s()));
    }
    if (phase.to_s() > out.duration) {
      validator.error(child_path(path, "to_s"), "must not be after the end, duration_s = " + number_text(out.duration));
    }
    out.phases.push_back({phase.name(), phase.from_s(), phase.to_s(), phase.contact()});
  }
}

void check_law(const pb::Scene& in, MessageValidator& validator, const SceneSpec& scene) {
  const bool joints = scene.port == PortSpace::kJoint;
  if (const auto problem = law_problem(scene)) {
    const bool written =
        problem->key != "channel.law" || in.channel().has_law();  // otherwise the location is the line of the port
    validator.error(written ? problem->key : "port", problem->words);
  }
  for (int i = 0; i < in.seat_size(); ++i)
    if (in.seat(i).assist().force_n() > 0 && scene.channel.law != LawKind::kReplica)
      validator.error(
          child_path(child_path("", "seat", i), "assist"),
          "needs channel { law: REPLICA }, under which clients know the leader's hand; remove it or write force_n: 0");
  const LawKind law = scene.channel.law;
  for (int i = 0; i < in.seat_size(); ++i)
    if (in.seat(i).force_separation() && (joints || law == LawKind::kTdpa || law == LawKind::kWave))
      validator.error(child_path(child_path("", "seat", i), "force_separation"),
                      "needs port: TIP and a law that sends positions: REPLICA, SET_POSITION, PD or RAW", "true");
  for (int i = 0; joints && i < in.seat_size(); ++i)
    if (in.seat(i).motion_scale() != 0 && in.seat(i).motion_scale() != 1)
      validator.error(child_path(child_path("", "seat", i), "motion_scale"),
                      "needs port: TIP, whose origin is the working pose; remove it or write 1");
  for (int t = 0; t < in.tool_size(); ++t)
    if (in.tool(t).contacts() == pb::Tool::ESTIMATED && scene.channel.law != LawKind::kReplica)
      validator.error(child_path(child_path("", "tool", t), "contacts"),
                      "needs channel { law: REPLICA }, under which clients simulate the tool; remove it or write NONE",
                      "ESTIMATED");
  for (std::size_t t = 0; t < scene.tools.size() && t < static_cast<std::size_t>(in.tool_size()); ++t)
    if (scene.tools[t].is_virtual && joints)
      validator.error(child_path(child_path(child_path("", "tool", static_cast<int>(t)), "slave"), "model"),
                      "is VIRTUAL, named or by default; it needs port: TIP, where surfaces are; for port: JOINT name "
                      "model: TOUCH or LINEAR",
                      "VIRTUAL");
}

/// Smallest spring to which law REPLICA reduces k_c for a device [N/m].
constexpr double kRenderedLeast = 1;

void check_passivity(const pb::Scene& in, MessageValidator& validator, const SceneSpec& scene) {
  if (scene.unsafe_gains || !(scene.tick_hz > 0)) return;
  const auto limit = [&](const SimDeviceSpec& device) {
    return stiffness_limit(device.damping, 0, 1 / scene.tick_hz);
  };  // simulated devices have no latency
  const auto judge = [&](double k, const SimDeviceSpec& device, const std::string& whose, const std::string& path) {
    if (k <= limit(device) * (1 + kSumTolerance)) return;
    validator.error(
        path,
        "is above the passivity limit b / (T/2) = " + number_text(limit(device)) + " N/m of " + whose + " (damping " +
            number_text(device.damping) + " N s/m, tick " + number_text(scene.tick_hz) +
            " Hz); lower it, raise tick_hz or the device's damping_n_s_m, or accept the risk with unsafe_gains: true",
        number_text(k));
  };
  const SeatSpec* weakest = nullptr;  // one k_c for all, so one error, for the most restrictive device
  for (const auto& seat : scene.seats) {
    if (seat.kind != SeatKind::kMaster) continue;
    if (weakest == nullptr || limit(seat.device) < limit(weakest->device)) weakest = &seat;
  }
  if (weakest != nullptr) {
    const std::string whose = "the device of seat " + quoted(weakest->name), path = "device_coupling.k_c_n_m";
    if (scene.channel.law != LawKind::kReplica) {
      judge(scene.coupling.k_c, weakest->device, whose, path);
    } else if (limit(weakest->device) < kRenderedLeast) {
      validator.error(path, "meets " + whose +
                                ", which renders at most b / (T/2) = " + number_text(limit(weakest->device)) +
                                " N/m (damping " + number_text(weakest->device.damping) + " N s/m, tick " +
                                number_text(scene.tick_hz) + " Hz); at least " + number_text(kRenderedLeast) +
                                " N/m are needed: raise the device's damping_n_s_m or tick_hz");
    }
  }
  for (std::size_t t = 0; t < scene.tools.size() && t < static_cast<std::size_t>(in.tool_size()); ++t) {
    const auto& tool = scene.tools[t];
    if (tool.is_virtual) continue;
    judge(tool.k_s, tool.slave, "the slave of tool " + quoted(tool.name),
          child_path(child_path("", "tool", static_cast<int>(t)), "k_s_n_m"));
  }
}

}  // namespace tandem::rules
