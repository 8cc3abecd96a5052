#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include "common/base/rng.h"
#include "proto/wire/wire_codec.h"

/// Random wire messages within their ranges, for tests.
namespace tandem::wire::samples {

inline void fill(RandomStream& random, EnergyArray& array, std::size_t axes) {
  for (std::size_t i = 0; i < axes; ++i) array[i] = random.below(kEnergyMax);
}
inline Preamble preamble(RandomStream& random) {
  return {random.bits(), static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(random.bits())};
}
/// Returns a value in [-limit, limit] that single precision represents exactly, so that messages can be compared.
inline double single(RandomStream& random, double limit) {
  return static_cast<double>(static_cast<float>(random.uniform(-limit, limit)));
}
inline void fill_single(RandomStream& random, AxisArray& array, std::size_t axes, double limit) {
  for (std::size_t i = 0; i < axes; ++i) array[i] = single(random, limit);
}
inline void port(RandomStream& random, std::size_t axes, PortSample& out) {
  fill_single(random, out.x, axes, 10);
  fill_single(random, out.v, axes, 100);
  fill_single(random, out.f, axes, 1e4);
  fill(random, out.e_in, axes);
}
/// Returns the layout of a seat with all parts that a TIP port can have.
inline BodyLayout tip(std::size_t axes, std::size_t further = 0) {
  return BodyLayout{.axes = axes, .port = PortSpace::kTip, .further = further}.valid();
}
inline StateMessage state(RandomStream& random, std::size_t axes) {
  StateMessage m;
  port(random, axes, m.port);
  for (std::size_t i = 0; i < axes; ++i) m.telemetry.q[i] = single(random, 50);
  for (auto& v : m.telemetry.x) v = single(random, 5);
  for (auto& v : m.telemetry.f_cmd) v = single(random, 100);
  for (auto& v : m.telemetry.f_out) v = single(random, 100);
  fill(random, m.telemetry.e_out, axes);
  m.telemetry.dissipated_j = single(random, 1000);
  m.telemetry.refused_j = single(random, 1000);
  m.telemetry.delivered_j = single(random, 1000);
  m.telemetry.margin_min_j = single(random, 1000);
  for (auto& v : m.telemetry.f_env) v = single(random, 100);
  m.telemetry.penetration_m = single(random, 1);
  for (double* v : {&m.telemetry.down_loss_percent, &m.telemetry.down_longest_gap_ms, &m.telemetry.down_age_p99_ms})
    *v = std::abs(single(random, 100));
  m.gate = static_cast<GateState>(random.below(7));
  m.ready = random.below(2) == 1;
  m.engaged = random.below(2) == 1;
  m.stop = random.below(2) == 1;
  m.stop_all = random.below(2) == 1;
  m.resume_stop = static_cast<std::uint32_t>(random.bits());
  for (std::size_t a = 0; a < axes; ++a) m.port.a[a] = single(random, 100);
  m.telemetry.gate_trips = static_cast<std::uint32_t>(random.bits());
  m.telemetry.late_ticks = static_cast<std::uint32_t>(random.bits());
  m.seat_tick = static_cast<std::uint32_t>(random.bits());
  return m;
}
/// Returns a random contact. @param axes  of the port, 1 to 3
inline LocalContact contact(RandomStream& random, std::size_t axes, std::uint32_t id) {
  LocalContact c;
  c.id = id;
  double square = 0;
  std::array<double, 3> n{};
  while (square < 0.01) {
    square = 0;
    for (std::size_t a = 0; a < axes; ++a) square += (n[a] = random.uniform(-1, 1)) * n[a];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    c.point[a] = static_cast<float>(random.uniform(-0.2, 0.2));
    c.normal[a] = static_cast<float>(n[a] / std::sqrt(square));
  }
  c.k = static_cast<float>(random.uniform(0, 1e6));
  c.b = static_cast<float>(random.uniform(0, 1000));
  c.mu = static_cast<float>(random.uniform(0, 2));
  return c;
}
/// Returns a value in [0, 1] that the wire represents exactly.
inline double slave_pull(RandomStream& random) { return static_cast<double>(random.below(65536)) / 65535; }
/// Adds 0 to 4 random contacts.
inline void contacts(RandomStream& random, std::size_t axes, LocalContactList& out) {
  const auto n = static_cast<std::uint32_t>(random.below(kLocalContactsMax + 1));
  for (std::uint32_t c = 0; c < n; ++c)
    out.add(contact(random, axes, 1 + c + 10 * static_cast<std::uint32_t>(random.below(1000))));
}
/// Returns the states of further couplings of a hand, in numbers that the wire represents exactly.
inline std::vector<PortSample> tie_states(RandomStream& random, std::size_t axes, std::size_t further) {
  std::vector<PortSample> all(further);
  for (PortSample& s : all) {
    fill_single(random, s.x, axes, 10);
    for (std::size_t a = 0; a < axes; ++a) {
      s.v[a] = single(random, 100);
      s.f[a] = single(random, 100);
      s.a[a] = single(random, 100);
    }
    fill(random, s.e_in, axes);
  }
  return all;
}
/// Returns the forces of further couplings. @param room  largest number of contacts in all of them together
inline std::vector<ToolForce> tie_forces(RandomStream& random, std::size_t axes, std::size_t further,
                                         std::size_t room) {
  std::vector<ToolForce> all(further);
  for (ToolForce& t : all) {
    fill_single(random, t.port.x, axes, 10);
    for (std::size_t a = 0; a < axes; ++a) {
      t.port.v[a] = single(random, 100);
      t.port.f[a] = single(random, 1);
    }
    fill(random, t.port.e_in, axes);
    t.alpha = std::abs(single(random, 1));
    t.slave_pull = slave_pull(random);
    if (contacts(random, axes, t.contacts); t.contacts.size > room) t.contacts.size = static_cast<std::uint32_t>(room);
    room -= t.contacts.size;
  }
  return all;
}
/// Returns the ghost of a random leader.
inline Ghost ghost(RandomStream& random) {
  Ghost out{.leader = 1 + static_cast<std::uint32_t>(random.below(kMastersMax))};
  for (float& x : out.x) x = static_cast<float>(random.uniform(-10, 10));
  for (float& v : out.v) v = static_cast<float>(random.uniform(-100, 100));
  return out;
}
inline ForceMessage force(RandomStream& random, std::size_t axes) {
  ForceMessage m;
  port(random, axes, m.port);
  m.session = static_cast<SessionState>(random.below(6));
  m.engage = random.below(2) == 1;
  m.session_tick = static_cast<std::uint32_t>(random.bits());
  m.authority_version = static_cast<std::uint32_t>(random.bits());
  m.missing = static_cast<std::uint32_t>(random.below(kSeatsMax + 1));
  m.alpha = random.uniform();
  m.stops = static_cast<std::uint32_t>(random.bits());
  m.transfer = static_cast<TransferNotice>(random.below(4));
  if (m.transfer == TransferNotice::kGaining || m.transfer == TransferNotice::kLosing) {
    const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random.below(n)); };
    m.transfer_ticks = below(kTransferNoticeTicks + 1);
    m.transfer_parties = {below(kSeatsMax + 2), below(kMastersMax + 1), below(101), below(kToolsMax)};
    if (m.transfer_parties.by > kSeatsMax) m.transfer_parties.by = TransferParties::kOperator;
  }
  m.touching = random.below(2) == 1;
  m.telemetry_every_tick = random.below(2) == 1;
  return m;
}
inline PathMessage path(RandomStream& random) { return {random.bits()}; }
inline AuthorityMessage authority(RandomStream& random) {
  AuthorityMessage m;
  m.version = static_cast<std::uint32_t>(random.bits());
  m.tool = static_cast<std::uint32_t>(random.below(kToolsMax));
  m.masters = static_cast<std::uint32_t>(1 + random.below(kMastersMax));
  double left = 1;
  for (std::size_t i = 0; i + 1 < m.masters; ++i) left -= m.alpha[i] = left * random.uniform();
  m.alpha[m.masters - 1] = left;
  return m;
}

}  // namespace tandem::wire::samples
