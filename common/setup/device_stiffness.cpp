#include "common/setup/device_stiffness.h"

#include <algorithm>
#include <limits>

#include "common/base/format.h"
#include "common/base/stiffness_limit.h"

namespace tandem::setup {

namespace {

double& spring_of(SeatSetup& setup) noexcept {
  return setup.seat.kind == SeatKind::kSlave ? setup.k_s : setup.coupling.k_c;
}

/// Law `replica` lets a hand feel its spring alone; the other laws add the spring and dampers of a channel.
double share(LawKind law) noexcept { return law == LawKind::kReplica ? kStiffnessShare : 1; }

double damping_of(const rpc::DeviceFacts& device) noexcept {
  return device.damping_n_s_m > 0 ? device.damping_n_s_m : kDampingUnknown;
}

const char* key_of(const SeatSetup& setup) noexcept {
  return setup.seat.kind == SeatKind::kSlave ? "k_s_n_m" : "k_c_n_m";
}

/// Returns why a device gets a softer spring, with all numbers.
std::string cause_text(const SeatSetup& setup, const rpc::DeviceFacts& device) {
  const bool known = device.damping_n_s_m > 0;
  std::string words = "this device renders at most ";
  words += share(setup.channel.law) < 1 ? format("%g b / (T/2 + t_d)", share(setup.channel.law))
                                        : std::string("b / (T/2 + t_d)");
  words += format(" (damping b %g N s/m%s, tick T %g ms, latency t_d %g ms)", damping_of(device),
                  known ? "" : " assumed as it is not known", 1e3 / setup.tick_hz, 1e3 * device.latency_s);
  if (!known) words += "; a device file may set damping_n_s_m";
  return words;
}

}  // namespace

double stiffness_for(const SeatSetup& setup, const rpc::DeviceFacts& device) noexcept {
  const bool no_force = device.force_peak_n <= 0 && device.damping_n_s_m <= 0;
  if (setup.unsafe_gains || no_force) return std::numeric_limits<double>::infinity();
  return share(setup.channel.law) * stiffness_limit(damping_of(device), device.latency_s, 1 / setup.tick_hz);
}

SeatSetup with_limited_stiffness(SeatSetup setup, const rpc::DeviceFacts& device) {
  constexpr double kRounding = 1 + 1e-9;  // 2 * 0.2 N s/m * 1000 Hz need not be 400 N/m to the last bit
  double& spring = spring_of(setup);
  if (const double most = stiffness_for(setup, device); spring > most * kRounding) spring = most;
  return setup;
}

std::string softened_text(const SeatSetup& setup, const rpc::DeviceFacts& device) {
  SeatSetup copy = setup;
  const double given = spring_of(copy);
  constexpr double kWorthAWord = 0.9;  // share of the scene's stiffness; users do not feel a tenth less
  if (!(given < kWorthAWord * setup.stiffness_asked)) return {};
  return format("%s is %.0f N/m instead of the scene's %.0f: ", key_of(setup), given, setup.stiffness_asked) +
         cause_text(setup, device);
}

rpc::DeviceFacts simulated_device(const SceneSpec& scene, std::size_t seat) {
  rpc::DeviceFacts device;
  device.simulated = true;
  return with_declared_properties(device, scene.seats[seat].device);
}

std::string granted_listing(const SceneSpec& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.seats.size(); ++i) {
    const rpc::DeviceFacts device = simulated_device(scene, i);
    SeatSetup asked = seat_setup(scene, i);
    SeatSetup granted = with_limited_stiffness(asked, device);
    if (!(spring_of(granted) < spring_of(asked))) continue;
    text += format("seat[%zu] %s: %s granted %.0f N/m of %.0f N/m: ", i, scene.seats[i].name.c_str(), key_of(asked),
                   spring_of(granted), spring_of(asked)) +
            cause_text(granted, device) + "\n";
  }
  return text;
}

rpc::DeviceFacts with_declared_properties(rpc::DeviceFacts device, const SimDeviceSpec& described) noexcept {
  if (!device.simulated || device.damping_n_s_m > 0 || device.force_peak_n > 0) return device;
  device.damping_n_s_m = described.damping;
  device.force_peak_n = described.force_peak;
  return device;
}

}  // namespace tandem::setup
