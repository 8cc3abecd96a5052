#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "common/control/channel.h"
#include "common/control/contact.h"
#include "common/control/flow_sources.h"
#include "proto/scene_spec.h"

/// From what a scene says to what the laws take. Both ends of a channel are built by the same lines, so they cannot differ.
namespace tandem::setup {

[[nodiscard]] std::string_view law_name(LawKind law) noexcept;
[[nodiscard]] control::FlowSourceMode flow_source_mode(MfsMode mode) noexcept;

/// The surfaces of a scene's own environment, as a virtual tool and its copies meet them.
[[nodiscard]] control::ContactSet contacts(const EnvironmentSpec& environment) noexcept;

/// @param scale  tip gain to port gain, per axis.
/// @param leashed  springs give way beyond `force_max`; not in scenes with `unsafe_gains`, which command what no motor delivers.
/// @param k_c  of the coupling between device and tool [N/m].
/// @param stiffness  of a SLAVE seat's spring (k_s), instead of the channel's [N/m].
[[nodiscard]] std::unique_ptr<control::ChannelEnd> make_channel(const ChannelSpec& spec, control::Side side, std::size_t dof,
                                                                const AxisArray& scale, double force_max, double k_c,
                                                                bool leashed, std::optional<double> stiffness);

}  // namespace tandem::setup
