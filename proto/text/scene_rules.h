#pragma once

#include "proto/schema/scene.pb.h"
#include "proto/spec/scene_spec.h"
#include "proto/text/message_validator.h"

/// Private to proto/text: the rules of a scene that need several values. Each function reads its part of `in` into
/// `out` and reports every error. Later functions tolerate what earlier ones rejected. Call them in this order.
namespace tandem::rules {

/// Seats (masters first, then slaves), tools, and the SLAVE seats of tools.
void read_seats_and_tools(const pb::Scene& in, text::MessageValidator& validator, SceneSpec& out);
/// Authority at the start and along the timeline. Every tool has a row, and every row sums to 1 over seats that may
/// lead.
void read_authority(const pb::Scene& in, text::MessageValidator& validator, SceneSpec& out);
/// The tools that every master follows; the default needs the authority.
void read_follow(const pb::Scene& in, text::MessageValidator& validator, SceneSpec& out);
void read_phases(const pb::Scene& in, text::MessageValidator& validator, SceneSpec& out);
/// Requirements of the channel law and of tools without a device.
void check_law(const pb::Scene& in, text::MessageValidator& validator, const SceneSpec& scene);
/// Checks springs that act on a sampled device: k <= b / (T/2 + t_d) (common/base/stiffness_limit.h). Law REPLICA
/// reduces each master's spring to the limit of its device. There k_c is a request, and only a device with almost no
/// renderable stiffness is an error.
void check_passivity(const pb::Scene& in, text::MessageValidator& validator, const SceneSpec& scene);
/// Checks whether the numerics solve the friction of surfaces and keep the proof of passivity.
void check_numerics(text::MessageValidator& validator, const SceneSpec& scene);

}  // namespace tandem::rules
