#pragma once

#include "proto/checker.h"
#include "proto/scene.pb.h"
#include "proto/scene_spec.h"

/// Private to proto/*.cpp: the rules of a scene that need several values. Each reads its part of `in` into `out` and
/// tells every mistake; later ones tolerate what earlier ones refused. Call in this order.
namespace tandem::rules {

/// Seats (masters first, then slaves), tools, and who serves which.
void read_seats_and_tools(const pb::Scene& in, text::Checker& checker, SceneSpec& out);
/// Authority at the start and along the timeline: every tool has a row, every row sums to 1 over seats that may lead.
void read_authority(const pb::Scene& in, text::Checker& checker, SceneSpec& out);
/// What every master follows; needs the authority for its default.
void read_follow(const pb::Scene& in, text::Checker& checker, SceneSpec& out);
void read_phases(const pb::Scene& in, text::Checker& checker, SceneSpec& out);
/// What the law of the channel and tools without a device need.
void check_law(const pb::Scene& in, text::Checker& checker, const SceneSpec& scene);
/// Springs that meet a sampled device: k <= b / (T/2 + t_d) (common/base/device_stiffness.h). Law REPLICA gives each hand a spring that its device
/// renders, so there k_c is what is asked for, and only a device that renders next to nothing is a mistake.
void check_passivity(const pb::Scene& in, text::Checker& checker, const SceneSpec& scene);

}  // namespace tandem::rules
