#include <algorithm>
#include <array>
#include <optional>

#include "proto/text/message_keys.h"
#include "proto/text/scene_convert.h"
#include "proto/text/scene_rules.h"
#include "proto/text/scene_text.h"

namespace tandem {
namespace {

using text::MessageValidator;

static_assert(static_cast<int>(IntegratorKind::kExact) == pb::Numerics::EXACT &&
              pb::Numerics::Integrator_MAX == pb::Numerics::EXACT);
static_assert(static_cast<int>(PrecisionKind::kFloat) == pb::Numerics::FLOAT &&
              pb::Numerics::Precision_MAX == pb::Numerics::FLOAT);

constexpr std::array<text::MessageKey<NumericsSpec>, 1> kNumericsKeys{{{"substeps", &NumericsSpec::substeps}}};

/// Key and value of the choice without the proof of passivity.
struct Choice {
  const char *key, *value;
};
Choice unproven(const NumericsSpec& numerics) {
  if (numerics.integrator == IntegratorKind::kImplicitEuler) return {"numerics.precision", "FLOAT"};
  return {"numerics.integrator",
          pb::Numerics::Integrator_Name(static_cast<pb::Numerics::Integrator>(numerics.integrator)).c_str()};
}

}  // namespace

void read_numerics(const pb::Numerics& in, NumericsSpec& out) {
  out.integrator = static_cast<IntegratorKind>(in.integrator());
  out.precision = static_cast<PrecisionKind>(in.precision());
  text::read_keys(in, kNumericsKeys, out);
}

void write_numerics(const NumericsSpec& in, pb::Numerics& out) {
  out.set_integrator(static_cast<pb::Numerics::Integrator>(in.integrator));
  out.set_precision(static_cast<pb::Numerics::Precision>(in.precision));
  text::write_keys(in, kNumericsKeys, out);
}

void check_friction(const NumericsSpec& numerics, const EnvironmentSpec& environment, const std::string& whose,
                    MessageValidator& validator) {
  if (numerics.keeps_proof()) return;
  const double mu =
      std::max(environment.wall ? environment.wall->mu : 0, environment.tissue ? environment.tissue->mu : 0);
  if (!(mu > 0)) return;
  const Choice choice = unproven(numerics);
  validator.error(choice.key,
                  "does not solve the friction of " + whose + ", friction: " + text::number_text(mu) +
                      "; use integrator: IMPLICIT_EULER with precision: DOUBLE, or set friction: 0",
                  choice.value);
}

void check_device_numerics(const SimDeviceSpec& device, const std::string& path, MessageValidator& validator) {
  const bool is_explicit = device.numerics && (device.numerics->integrator == IntegratorKind::kSemiImplicitEuler ||
                                               device.numerics->integrator == IntegratorKind::kRk4);
  if (!is_explicit || !(device.friction > 0)) return;
  validator.error(text::child_path(path, "integrator"),
                  "is explicit and cannot follow friction at rest, friction_n: " + text::number_text(device.friction) +
                      "; use IMPLICIT_EULER, IMPLICIT_MIDPOINT or EXACT, or set friction_n: 0",
                  pb::Numerics::Integrator_Name(static_cast<pb::Numerics::Integrator>(device.numerics->integrator)));
}

std::optional<LawProblem> numerics_problem(const SceneSpec& scene) {
  if (scene.numerics.is_default()) return std::nullopt;
  for (const ToolSpec& tool : scene.tools) {
    if (tool.is_virtual || (tool.remote && scene.channel.law == LawKind::kReplica)) continue;
    return LawProblem{"numerics",
                      "steps simulated tools, but tool \"" + tool.name +
                          "\" is moved with a device; give it slave { model: VIRTUAL } (or, if a SLAVE seat "
                          "serves it, use law: REPLICA), or remove numerics"};
  }
  return std::nullopt;
}

void rules::check_numerics(MessageValidator& validator, const SceneSpec& scene) {
  for (const ToolSpec& tool : scene.tools)
    if (tool.is_virtual) check_friction(scene.numerics, tool.environment, "tool \"" + tool.name + '"', validator);
  if (scene.numerics.keeps_proof() || scene.unsafe_gains) return;
  const Choice choice = unproven(scene.numerics);
  validator.error(choice.key,
                  "loses the proof that no step creates energy; use integrator: IMPLICIT_EULER with precision: DOUBLE "
                  "and any substeps, or accept the risk with unsafe_gains: true",
                  choice.value);
}

}  // namespace tandem
