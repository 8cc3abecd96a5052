#include <cmath>

#include "proto/text/scene_convert.h"
#include "proto/text/scene_text.h"

namespace tandem {
namespace {

void write_rows(const SceneSpec& scene, const AuthorityRow& row,
                google::protobuf::RepeatedPtrField<pb::Authority>& out) {
  for (std::size_t seat = 0; seat < scene.seats.size(); ++seat) {
    if (row.alpha[seat] == 0) continue;
    auto& entry = *out.Add();
    entry.set_tool(scene.tools[row.tool].name);
    entry.set_seat(scene.seats[seat].name);
    entry.set_alpha(row.alpha[seat]);
  }
}

}  // namespace

pb::Scene to_proto(const SceneSpec& scene) {
  pb::Scene out;
  out.set_version(1);
  out.set_tick_hz(scene.tick_hz);
  out.set_dof(static_cast<std::uint32_t>(scene.dof));
  out.set_port(static_cast<pb::Scene::Port>(scene.port));
  if (!scene.endless()) out.set_duration_s(scene.duration);
  out.set_clock_runs_while_stopped(scene.clock_runs_while_stopped);
  if (std::isfinite(scene.alpha_slew)) {
    out.set_alpha_slew_per_s(scene.alpha_slew);
  } else {
    out.set_alpha_step(true);
  }
  out.set_unsafe_gains(scene.unsafe_gains);
  out.set_judged_on(scene.commanded_force ? pb::Scene::COMMANDED : pb::Scene::DELIVERED);
  write_channel(scene.channel, *out.mutable_channel());
  write_coupling(scene.coupling, *out.mutable_device_coupling());
  write_gate(scene.gate, *out.mutable_gate());
  write_numerics(scene.numerics, *out.mutable_numerics());
  if (scene.send.is_on()) write_send(scene.send, *out.mutable_send());
  for (const auto& seat : scene.seats) {
    auto& s = *out.add_seat();
    write_seat(seat, s);
    if (seat.kind == SeatKind::kSlave) s.set_tool(scene.tools[seat.tool].name);
  }
  for (const auto& tool : scene.tools) {
    auto& t = *out.add_tool();
    t.set_name(tool.name);
    t.set_k_s_n_m(tool.k_s);
    t.set_m_s_kg(tool.m_s);
    t.set_b_s_n_s_m(tool.b_s);
    if (tool.is_virtual) {
      t.mutable_slave()->set_model(pb::VIRTUAL);
      write_point(tool.slave.start, *t.mutable_slave()->mutable_start_m());
      write_environment(tool.environment, *t.mutable_slave()->mutable_environment());
      continue;
    }
    if (tool.remote && scene.channel.law == LawKind::kReplica)
      t.set_contacts(static_cast<pb::Tool::Contacts>(tool.contacts));
    if (!tool.remote) write_slave(tool.slave, tool.environment, *t.mutable_slave());
  }
  for (const auto& row : scene.authority) write_rows(scene, row, *out.mutable_authority());
  for (std::size_t seat = 0; seat < scene.seats.size(); ++seat) {
    for (std::size_t tool = 0; tool < scene.tools.size(); ++tool) {
      if (scene.follow[seat][tool] == 0) continue;
      auto& entry = *out.add_follow();
      entry.set_seat(scene.seats[seat].name);
      entry.set_tool(scene.tools[tool].name);
      entry.set_weight(scene.follow[seat][tool]);
    }
  }
  pb::Timeline* step = nullptr;
  for (const auto& timed : scene.timeline) {
    if (step == nullptr || step->at_s() != timed.at) {
      step = out.add_timeline();
      step->set_at_s(timed.at);
    }
    write_rows(scene, timed.row, *step->mutable_authority());
  }
  for (const auto& phase : scene.phases) {
    auto& p = *out.add_phase();
    p.set_name(phase.name);
    p.set_from_s(phase.from);
    p.set_to_s(phase.to);
    p.set_contact(phase.contact);
  }
  return out;
}

std::string effective_scene_text(const SceneSpec& scene) {
  return (scene.endless() ? "duration_s: none given, the session lasts until it is ended\n" : "") +
         text::listing(to_proto(scene));
}

}  // namespace tandem
