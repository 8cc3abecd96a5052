#include "netsim/replay/record_values.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

/// Visits the numbers of a record in their order: owner and channel, field with its index from 1 (0: none), value.
template <class Visit>
void visit_record(const SceneSpec& scene, const server::TickRecord& record, Visit&& visit) {
  const auto triple = [&](const std::string& owner, const char* channel, const server::Triple& values) {
    constexpr const char* kAxes[] = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k) visit(owner, channel, kAxes[k], 0, values[k]);
  };
  const auto joints = [&](const std::string& owner, const AxisArray& values) {
    for (std::size_t a = 0; a < values.size(); ++a) visit(owner, "measured_js", "q", a + 1, values[a]);
  };
  const auto energies = [&](const std::string& owner, const char* field, const EnergyArray& values) {
    for (std::size_t a = 0; a < scene.dof; ++a) visit(owner, "energy", field, a + 1, static_cast<double>(values[a]));
  };
  const auto one = [&](const std::string& owner, const char* channel, const char* field, double value) {
    visit(owner, channel, field, 0, value);
  };
  static const std::string kSession = "session";
  one(kSession, "clock", "tick", record.tick);
  one(kSession, "clock", "running", record.running ? 1 : 0);
  one(kSession, "clock", "stopped_ticks", static_cast<double>(record.stopped_ticks));
  one(kSession, "clock", "dropped_ticks", static_cast<double>(record.dropped_ticks));
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const server::SeatRecord& r = record.seats[i];
    const std::string& seat = scene.seats[i].name;
    joints(seat, r.q);
    triple(seat, "measured_cp", r.x);
    triple(seat, "servo_cf", r.f_cmd);
    triple(seat, "measured_cf", r.f_out);
    energies(seat, "in_nj", r.e_in);
    energies(seat, "out_nj", r.e_out);
    one(seat, "energy", "dissipated_j", r.dissipated_j);
    one(seat, "energy", "refused_j", r.refused_j);
    one(seat, "energy", "margin_min_j", r.margin_min_j);
    one(seat, "energy", "delivered_j", r.delivered_j);
    one(seat, "authority", "alpha", r.alpha);
    one(seat, "state", "engaged", r.engaged ? 1 : 0);
    one(seat, "state", "gate", static_cast<double>(r.gate));
    one(seat, "state", "leader", r.leader);
    one(seat, "state", "sample_tick", r.sample_tick);
    triple(seat, "ghost", r.ghost);
  }
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    const server::ToolRecord& r = record.tools[j];
    const std::string& tool = scene.tools[j].name;
    joints(tool, r.q);
    triple(tool, "measured_cp", r.x);
    triple(tool, "setpoint_cp", r.x_tool);
    triple(tool, "servo_cf", r.f_cmd);
    triple(tool, "measured_cf", r.f_env);
    one(tool, "state", "penetration", r.penetration);
    one(tool, "state", "held", r.held ? 1 : 0);
    one(tool, "state", "sample_tick", r.sample_tick);
    one(tool, "energy", "mfs_j", r.mfs_j);
    one(tool, "energy", "e_p_j", r.e_p_j);
    triple(tool, "energy_p", r.e_p_axis_j);
  }
}

}  // namespace

RecordValues::RecordValues(const SceneSpec& scene) {
  visit_record(scene, server::TickRecord{},
               [&](const std::string& owner, const char* channel, const char* field, std::size_t index, double) {
                 names_.push_back({"/" + owner + "/" + channel, field + (index > 0 ? std::to_string(index) : "")});
               });
}

void RecordValues::read(const SceneSpec& scene, const server::TickRecord& record, std::vector<double>& out) {
  out.clear();
  visit_record(scene, record, [&](const std::string&, const char*, const char*, std::size_t, double value) {
    out.push_back(value);
  });
}

std::optional<ReplayDifference> RecordValues::difference(const std::vector<double>& recorded,
                                                         const std::vector<double>& replayed) const {
  for (std::size_t k = 0; k < names_.size(); ++k) {
    if (std::bit_cast<std::uint64_t>(recorded[k]) == std::bit_cast<std::uint64_t>(replayed[k]) ||
        std::isnan(recorded[k]))
      continue;
    const std::string field = names_[k].field + " ";
    return ReplayDifference{.channel = names_[k].channel,
                            .recorded = field + format("%.17g", recorded[k]),
                            .replayed = field + format("%.17g", replayed[k])};
  }
  return std::nullopt;
}

}  // namespace tandem::netsim
