#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

/// One energy oracle for all channel laws. A channel of three axes lies between a hand, which holds the handle of a
/// device, and a tool, which touches a wall. The oracle measures the energy that the motors give to the hand as force
/// times motion of the device. It reads no account of a law, so an account that is wrong cannot hide what it permits.
namespace tandem::test {

/// Parameters of one run of the oracle.
struct Trial {
  std::string_view law;     ///< name of the law
  std::uint64_t seed = 1;   ///< of hand, wall, network and, for `replica`, the other hands
  int ticks = 3000;         ///< [ms]
  int delay = 0;            ///< constant delay [ticks]; 0: a hostile network
  bool unlimited = false;   ///< the accounts start with 1 kJ; a negative control, because they then limit nothing
  bool grants = false;      ///< `replica`: the open flow sources pay for what a follower needs
  bool dead_band = false;   ///< both ends hold datagrams back (common/control/send_pace.h)
  std::uint32_t order = 1;  ///< `dead_band`: order of the prediction
  /// `dead_band`: the receivers also extrapolate energies; a negative control, because they then spend what the other
  /// end never absorbed.
  bool predicts_energy = false;
};

/// Initial energy E_0 of each axis and end [J].
inline constexpr double kInitialEnergy = 0.01;
/// Largest force of the motors [N].
inline constexpr double kMotorMax = 3.3;

/// Result of one run. The energy that a sampled spring k_c creates, 1/2 k_c dq^2 per tick, is subtracted from all
/// energies: the damping of the device pays for it [Colgate & Schenkel, J. Robotic Systems 14(1) 1997].
struct Verdict {
  /// Largest energy that the motors of all axes gave, less what they took [J]; over all instants.
  double given = -std::numeric_limits<double>::infinity();
  double worst_axis = -std::numeric_limits<double>::infinity();  ///< the same of one axis [J]
  /// Largest excess of `given` above the bound of the law and what was granted at that instant [J].
  double excess = -std::numeric_limits<double>::infinity();
  double moved = 0;  ///< largest distance of the tool from its start [m]
  double sent = 0;   ///< share of the samples that both ends sent
  bool finite = true;
};

/// Returns the energy that a law may give to a hand, beyond grants [J]; infinity if it states no bound.
///
///     replica                     E_0 of each axis at the client; nothing is paid at the server
///     set_position, tdpa, wave    E_0 of each axis and end
///     pd, raw                     none
///
/// The bound of the second row holds for each axis alone. That of `replica` holds for the sum: the norm of the motor's
/// force is limited, so a force on one axis depends on the others.
[[nodiscard]] double stated_bound(std::string_view law);

/// Runs one channel. Over the same seed, every law meets the same hand, wall and network.
[[nodiscard]] Verdict judge(const Trial& trial);

}  // namespace tandem::test
