#include "netsim/system/not_engaged_reason.h"

#include <algorithm>

#include "common/base/format.h"

namespace tandem::netsim {

namespace {

double ms(Duration d) { return 1e3 * seconds(d); }

}  // namespace

std::string not_engaged_reason(const SceneSpec& scene, std::size_t i, const client::Seat* core,
                               const server::Session& session, Time own, Time now) {
  const std::string& name = scene.seats[i].name;
  if (core == nullptr) return name + " never got its seat";
  const transport::LinkTiming& down = core->link().timing();
  const double age_max = 1e3 * scene.gate.loop_age_max, silence_max = 1e3 * scene.gate.silence_limit;
  if (!down.heard())
    return name +
           " received nothing from the server: every datagram to it is lost; check the network's loss, size and outage "
           "keys";
  if (down.rtt_samples() == 0)
    return name + format(
                      " measured no round trip: none of its datagrams was answered within %.0f ms, and "
                      "gate.loop_age_max_ms = %.0f "
                      "allows no such loop (20 to 2500); lower the network's delay or loss",
                      ms(transport::LinkTiming::kMemory), age_max);
  const double loop = std::max(ms(down.rtt_p50()), std::min(ms(down.loop_age(own)), ms(down.rtt_p99())));
  if (loop > age_max)
    return name + format(
                      " could not be engaged: its loop is %.0f ms old (both ways), above gate.loop_age_max_ms = %.0f "
                      "(20 to 2500); "
                      "raise that key or lower the network's delay",
                      loop, age_max);
  if (const double gap = ms(core->link().stats().longest_gap); core->gate().trips() > 0 && gap >= silence_max)
    return name + format(
                      " was engaged and released %u times: its datagrams come up to %.0f ms apart, above "
                      "gate.silence_limit_ms = %.0f; "
                      "raise that key or send over a network that loses and holds less",
                      core->gate().trips(), gap, silence_max);
  if (core->requests().locally_stopped()) return name + " stopped its own hand";
  if (!session.seat(i).ready(now))
    return name + format(" is not ready: its last datagram reached the server %.0f ms ago",
                         session.seat(i).taken() ? ms(session.seat(i).silence(now)) : 0.0);
  return name + " is ready and waits for the others";
}

}  // namespace tandem::netsim
