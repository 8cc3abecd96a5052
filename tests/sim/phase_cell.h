#pragma once

#include <array>
#include <cstdint>

#include "netsim/feel/feel_keys.h"
#include "netsim/feel/probes.h"

/// Effect of the phases of the clients' ticks within the server's tick on the loop and the feel of a hand.
namespace tandem::test {

/// Numbers of one cell, by key.
inline constexpr std::array<netsim::FeelKey, 8> kPhaseKeys{{
    {"loop_s", "loop at the hand's tick", "ms", 1e3},
    {"drag_05hz_n", "drag, 0.5 Hz, 50 mm, RMS", "N"},
    {"drag_05hz_n_s_m", "  damping felt", "N s/m"},
    {"apparent_mass_05hz_kg", "  mass felt", "g", 1e3},
    {"overshoot", "overshoot of the tool, 20 mm in 0.15 s", "%", 100},
    {"stiffness_felt_n_m", "stiffness felt on bone", "N/m", 1, true},
    {"stiffness_bone_held_n_m", "  held still on bone", "N/m", 1, true},
    {"limit_cycle_n", "force above 1 Hz at rest, worst hand", "N"},
}};

/// Runs the probes free, press and rest with hands drawn from the seed.
/// @param one_way_ms  constant delay of each direction
/// @throws std::runtime_error if a session does not run
[[nodiscard]] netsim::FeelValues felt(const SceneSpec& scene, double one_way_ms, netsim::ClientPhases phases,
                                      std::uint64_t seed);

/// Returns the mean time from sending a STATE to the hand's tick that uses the FORCE that answers it [s], once the
/// client's phase is at rest: from 2 s of the session time to its end at 4 s.
[[nodiscard]] double loop_of(const netsim::FeelSetup& setup, std::uint64_t seed);

}  // namespace tandem::test
