#include <algorithm>
#include <string>
#include <tuple>

#include "proto/text/scene_convert.h"

/// Environments of tools, and virtual tools, which touch them directly.
namespace tandem {

using text::child_path;
using text::MessageValidator;

namespace {

int axis_in(bool given, pb::Axis axis, int fallback, std::size_t dof, const std::string& path,
            MessageValidator& validator) {
  const int index = given ? static_cast<int>(axis) : fallback;
  if (index < 0 || static_cast<std::size_t>(index) >= dof) {
    validator.error(child_path(path, "axis"), "there is no such axis when dof is " + std::to_string(dof));
  }
  return std::clamp(index, 0, 2);
}

}  // namespace

void read_environment(const pb::Environment& in, std::size_t dof, const std::string& path, MessageValidator& validator,
                      EnvironmentSpec& out) {
  if (in.has_wall()) {
    const auto& w = in.wall();
    auto& wall = out.wall.emplace();
    wall.axis = axis_in(w.has_axis(), w.axis(), wall.axis, dof, child_path(path, "wall"), validator);
    if (w.has_at_m()) wall.at = w.at_m();
    if (w.has_k_n_m()) wall.k = w.k_n_m();
    if (w.has_b_n_s_m()) wall.b = w.b_n_s_m();
    if (w.has_from_below()) wall.from_below = w.from_below();
    if (w.has_friction()) wall.mu = w.friction();
  }
  if (in.has_tissue()) {
    const auto& t = in.tissue();
    auto& tissue = out.tissue.emplace();
    tissue.axis = axis_in(t.has_axis(), t.axis(), tissue.axis, dof, child_path(path, "tissue"), validator);
    if (t.has_at_m()) tissue.at = t.at_m();
    if (t.has_k_n_m()) tissue.k = t.k_n_m();
    if (t.has_k3_n_m3()) tissue.k3 = t.k3_n_m3();
    if (t.has_b_n_s_m()) tissue.b = t.b_n_s_m();
    if (t.has_from_below()) tissue.from_below = t.from_below();
    if (t.has_friction()) tissue.mu = t.friction();
  }
}

void refuse_friction(const pb::Environment& in, const std::string& path, MessageValidator& validator) {
  for (const auto& [above, surface, mu] : {std::tuple{in.wall().friction() > 0, "wall", in.wall().friction()},
                                           {in.tissue().friction() > 0, "tissue", in.tissue().friction()}})
    if (above)
      validator.error(child_path(child_path(path, surface), "friction"),
                      "must be 0: only a VIRTUAL slave meets friction; the surfaces of simulated devices are smooth",
                      text::number_text(mu));
}

void write_environment(const EnvironmentSpec& in, pb::Environment& out) {
  if (in.wall) {
    auto& wall = *out.mutable_wall();
    wall.set_axis(static_cast<pb::Axis>(in.wall->axis));
    wall.set_at_m(in.wall->at);
    wall.set_k_n_m(in.wall->k);
    wall.set_b_n_s_m(in.wall->b);
    wall.set_from_below(in.wall->from_below);
    wall.set_friction(in.wall->mu);
  }
  if (in.tissue) {
    auto& tissue = *out.mutable_tissue();
    tissue.set_axis(static_cast<pb::Axis>(in.tissue->axis));
    tissue.set_at_m(in.tissue->at);
    tissue.set_k_n_m(in.tissue->k);
    tissue.set_k3_n_m3(in.tissue->k3);
    tissue.set_b_n_s_m(in.tissue->b);
    tissue.set_from_below(in.tissue->from_below);
    tissue.set_friction(in.tissue->mu);
  }
}

void read_virtual_slave(const pb::Slave& in, std::size_t dof, const std::string& path, MessageValidator& validator,
                        Point& start, EnvironmentSpec& environment) {
  start = {in.start_m().x(), in.start_m().y(), in.start_m().z()};  // absent: 0
  pb::Slave rest = in;
  rest.clear_model();
  rest.clear_start_m();
  rest.clear_environment();
  if (rest.ByteSizeLong() > 0)
    validator.error(child_path(path, "model"),
                    "is VIRTUAL, named or by default, and has no device: take the numbers of a device away, all but "
                    "start_m and environment, or name model: TOUCH or LINEAR",
                    "VIRTUAL");
  if (dof == 1 && (start.y != 0 || start.z != 0))
    validator.error(child_path(path, "start_m"), "a tool with 1 axis moves along x only");
  read_environment(in.environment(), dof, child_path(path, "environment"), validator, environment);
}

}  // namespace tandem
