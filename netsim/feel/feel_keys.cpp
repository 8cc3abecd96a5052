#include "netsim/feel/feel_keys.h"

#include <array>
#include <cmath>
#include <limits>

namespace tandem::netsim {
namespace {

constexpr FeelKey kContact[] = {
    {"stiffness_felt_n_m", "stiffness felt on bone (20 kN/m)", "N/m", 1, true},
    {"stiffness_tissue_n_m", "stiffness felt on tissue (300 N/m)", "N/m", 1, true},
    {"stiffness_bone_held_n_m", "  held still on bone, force over depth", "N/m", 1, true},
    {"stiffness_tissue_held_n_m", "  held still on tissue", "N/m", 1, true},
    {"force_got_n", "force felt while pressing on bone", "N", 1, true},
    {"force_wanted_n", "the same over a perfect network", "N", 1, true},
    {"force_share", "share of that force", "%", 100, true},
    {"tool_felt_bone_n", "tool's force minus felt, at rest, bone", "N"},
    {"tool_felt_tissue_n", "tool's force minus felt, at rest, tissue", "N"},
};
constexpr FeelKey kFree[] = {
    {"drag_05hz_n", "drag on the leader, 0.5 Hz, 50 mm, RMS", "N"},
    {"drag_1hz_n", "drag on the leader, 1 Hz, 30 mm, RMS", "N"},
    {"drag_05hz_n_s_m", "  damping felt at 0.5 Hz", "N s/m"},
    {"drag_1hz_n_s_m", "  damping felt at 1 Hz", "N s/m"},
    {"apparent_mass_05hz_kg", "  mass felt at 0.5 Hz", "g", 1e3},
    {"apparent_mass_1hz_kg", "  mass felt at 1 Hz", "g", 1e3},
    {"leader_tool_05hz_m", "leader to tool, 0.5 Hz, RMS", "mm", 1e3},
    {"transport_lag_05hz_m", "  transport lag alone", "mm", 1e3},
    {"leader_tool_1hz_m", "leader to tool, 1 Hz, RMS", "mm", 1e3},
    {"transport_lag_1hz_m", "  transport lag alone", "mm", 1e3},
    {"leader_tool_step_m", "leader to tool, step of 20 mm, RMS", "mm", 1e3},
    {"transport_lag_step_m", "  transport lag alone", "mm", 1e3},
    {"leader_tool_recorded_m", "leader to tool, recorded motion, RMS", "mm", 1e3},
    {"transport_lag_recorded_m", "  transport lag alone", "mm", 1e3},
    {"overshoot", "overshoot of the tool, 20 mm in 0.15 s", "%", 100},
    {"overshoot_above_hand", "  above the highest point of the hand", "%", 100},
    {"follower_tool_05hz_m", "follower to tool, 0.5 Hz, RMS", "mm", 1e3},
    {"follower_tool_1hz_m", "follower to tool, 1 Hz, RMS", "mm", 1e3},
    {"follower_tool_step_m", "follower to tool, step, RMS", "mm", 1e3},
    {"follower_tool_recorded_m", "follower to tool, recorded, RMS", "mm", 1e3},
    {"follower_force_05hz_n", "force on a relaxed follower, 0.5 Hz, RMS", "N"},
    {"follower_step_05hz_n_ms", "  its largest step", "N/ms"},
    {"follower_force_1hz_n", "force on a relaxed follower, 1 Hz, RMS", "N"},
    {"follower_step_1hz_n_ms", "  its largest step", "N/ms"},
};
constexpr FeelKey kGain[] = {
    {"gain_max", "largest gain, tool over hand", ""},
    {"gain_0.25hz", "  at 0.25 Hz", ""},
    {"gain_0.5hz", "  at 0.5 Hz", ""},
    {"gain_1hz", "  at 1 Hz", ""},
    {"gain_2hz", "  at 2 Hz", ""},
    {"gain_3hz", "  at 3 Hz", ""},
    {"gain_4hz", "  at 4 Hz", ""},
    {"gain_5hz", "  at 5 Hz", ""},
    {"gain_6hz", "  at 6 Hz", ""},
    {"gain_8hz", "  at 8 Hz", ""},
    {"gain_10hz", "  at 10 Hz", ""},
};
constexpr FeelKey kRest[] = {
    {"limit_cycle_n", "force above 1 Hz at rest, worst hand, RMS", "N"},
    {"limit_cycle_firm_n", "  firm hand, 1000 N/m", "N"},
    {"limit_cycle_resting_n", "  resting hand, 50 N/m, 5 N s/m", "N"},
    {"limit_cycle_soft_n", "  soft hand, 50 N/m, 1 N s/m, 0.2 kg", "N"},
    {"limit_cycle_relaxed_n", "  relaxed hand, 2 N s/m", "N"},
};
constexpr FeelKey kRelease[] = {
    {"released_settles", "released frictionless handle settles", "%", 100, true},
    {"released_m", "its motion afterwards, worst spring, RMS", "mm", 1e3},
    {"released_100_m", "  on 100 N/m", "mm", 1e3},
    {"released_300_m", "  on 300 N/m", "mm", 1e3},
    {"released_1000_m", "  on 1000 N/m", "mm", 1e3},
    {"released_5000_m", "  on 5000 N/m", "mm", 1e3},
    {"released_20000_m", "  on 20000 N/m", "mm", 1e3},
};
constexpr FeelKey kHandOver[] = {
    {"handover_bump_n", "largest change of force, either hand", "N"},
    {"handover_step_n_ms", "largest step", "N/ms"},
    {"handover_step_before_n_ms", "  the same in the second before", "N/ms"},
};
constexpr FeelKey kShare[] = {
    {"shared_cycle_n", "force above 1 Hz at rest, worst, RMS", "N"},
    {"shared_cycle_2_n", "  the kicked hand has 2 % of authority", "N"},
    {"shared_cycle_10_n", "  10 %", "N"},
    {"shared_cycle_50_n", "  50 %", "N"},
    {"shared_cycle_90_n", "  90 %", "N"},
    {"shared_cycle_98_n", "  98 %", "N"},
};
constexpr FeelKey kFollow[] = {
    {"follower_offset_m", "relaxed follower beside the leader's hand, RMS", "mm", 1e3},
    {"follower_offset_still_m", "  2 s after a step of 42 mm, leader still", "mm", 1e3},
    {"follower_offset_slow_m", "  leader at 13 mm/s", "mm", 1e3},
    {"follower_wander_m", "  variation within a second, leader still", "mm", 1e3},
    {"follower_offset_contact_m", "leader presses 10 mm into bone", "mm", 1e3},
};
constexpr FeelKey kExposure[] = {
    {"engaged_share", "time in which the leader was engaged", "%", 100, true},
    {"held_share", "time in which the tool was braked", "%", 100},
    {"trips_per_min", "releases of the hand (gate trips)", "1/min"},
    {"saturated_share", "time at the motors' limit", "%", 100},
    {"delivered_error_n", "commanded minus delivered force, RMS", "N"},
    {"sent_up_share", "datagrams of clients, of one per tick", "%", 100},
    {"sent_down_share", "datagrams to clients, of one per tick", "%", 100},
};
constexpr std::array<FeelSection, 9> kSections{{
    {Probe::kPress, "Pressing", kContact},
    {Probe::kFree, "Free motion", kFree},
    {Probe::kGain, "Tool over hand, circles of 3 mm", kGain},
    {Probe::kRest, "At rest, from 5 s after a kick, without tremor", kRest},
    {Probe::kRelease, "Released, about 1 N pulls against a spring", kRelease},
    {Probe::kHandOver, "Handing authority over, both hands press on bone", kHandOver},
    {Probe::kShare, "Two hands share a tool, firm and soft, from 5 s after a kick", kShare},
    {Probe::kFollow, "Following: hand of a relaxed follower against the leader's", kFollow},
    {Probe::kFree, "While pressing and in free motion", kExposure},
}};

}  // namespace

std::span<const FeelSection> feel_sections() { return kSections; }

const FeelKey* find_feel_key(std::string_view key) {
  for (const FeelSection& section : kSections)
    for (const FeelKey& one : section.keys)
      if (one.key == key) return &one;
  return nullptr;
}

std::string_view si_unit(std::string_view key) {
  if (key == "trips_per_min") return "1/min";
  constexpr std::pair<std::string_view, std::string_view> kEnds[] = {
      {"_n_s_m", "N s/m"}, {"_n_ms", "N/ms"}, {"_n_m", "N/m"}, {"_n", "N"}, {"_m", "m"}, {"_kg", "kg"}};
  for (const auto& [end, unit] : kEnds)
    if (key.ends_with(end)) return unit;
  return "";
}

void put_exposure(const Exposure& e, FeelValues& values) {
  const auto share = [&](double part) { return e.s > 0 ? part / e.s : std::numeric_limits<double>::quiet_NaN(); };
  values["engaged_share"] = share(e.engaged_s);
  values["held_share"] = share(e.held_s);
  values["saturated_share"] = share(e.saturated_s);
  values["trips_per_min"] = share(60 * e.trips);
  values["delivered_error_n"] = std::sqrt(share(e.error_square));
  if (!(e.send_ticks > 0)) return;  // one datagram per tick
  values["sent_up_share"] = e.sent_up / e.send_ticks;
  values["sent_down_share"] = e.sent_down / e.send_ticks;
}

}  // namespace tandem::netsim
