#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "common/control/channel.h"
#include "common/control/contact.h"
#include "common/control/flow_sources.h"
#include "common/control/hand_coupling.h"
#include "common/control/numerics.h"
#include "proto/spec/scene_spec.h"

/// Builds the control laws from a scene. Both ends of a channel use this code, so they cannot differ.
namespace tandem::setup {

[[nodiscard]] std::string_view law_name(LawKind law) noexcept;
[[nodiscard]] control::FlowSourceMode flow_source_mode(MfsMode mode) noexcept;

[[nodiscard]] control::HandCoupling hand_coupling(HandCouplingKind kind) noexcept;

/// Returns how a simulated tool and its copies are stepped.
[[nodiscard]] control::Numerics numerics(const NumericsSpec& spec) noexcept;

/// Returns the surfaces of the scene's own environment, for a virtual tool and its copies.
[[nodiscard]] control::ContactSet contacts(const EnvironmentSpec& environment) noexcept;

/// Returns one end of a channel.
/// @param scale  tip gain to port gain, per axis
/// @param clamped  springs yield beyond `force_max`; false in scenes with `unsafe_gains`, which command forces that no
/// motor delivers
/// @param k_c  stiffness of the coupling between device and tool [N/m]
/// @param stiffness  stiffness of a SLAVE seat's spring (k_s) in place of the channel's [N/m]
/// @param motion_scale  s of the seat (client/seat/motion_scale.h). Gains and forces above are those at its hand; the
/// end is at the tool, where a stiffness is k / s^2 and a force F / s.
[[nodiscard]] std::unique_ptr<control::ChannelEnd> make_channel(const ChannelSpec& spec, control::Side side,
                                                                std::size_t dof, const AxisArray& scale,
                                                                double force_max, double k_c, bool clamped,
                                                                std::optional<double> stiffness,
                                                                double motion_scale = 1);

}  // namespace tandem::setup
