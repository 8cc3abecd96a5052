#include <algorithm>
#include <string>
#include <tuple>

#include "proto/text/message_keys.h"
#include "proto/text/scene_convert.h"

/// Environments of tools, and virtual tools, which touch them directly.
namespace tandem {

using text::child_path;
using text::MessageKey;
using text::MessageValidator;

namespace {

constexpr std::array<MessageKey<WallSpec>, 5> kWallKeys{{{"at_m", &WallSpec::at},
                                                         {"k_n_m", &WallSpec::k},
                                                         {"b_n_s_m", &WallSpec::b},
                                                         {"from_below", &WallSpec::from_below},
                                                         {"friction", &WallSpec::mu}}};
constexpr std::array<MessageKey<TissueSpec>, 6> kTissueKeys{{{"at_m", &TissueSpec::at},
                                                             {"k_n_m", &TissueSpec::k},
                                                             {"k3_n_m3", &TissueSpec::k3},
                                                             {"b_n_s_m", &TissueSpec::b},
                                                             {"from_below", &TissueSpec::from_below},
                                                             {"friction", &TissueSpec::mu}}};

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
    text::read_keys(w, kWallKeys, wall);
  }
  if (in.has_tissue()) {
    const auto& t = in.tissue();
    auto& tissue = out.tissue.emplace();
    tissue.axis = axis_in(t.has_axis(), t.axis(), tissue.axis, dof, child_path(path, "tissue"), validator);
    text::read_keys(t, kTissueKeys, tissue);
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
    out.mutable_wall()->set_axis(static_cast<pb::Axis>(in.wall->axis));
    text::write_keys(*in.wall, kWallKeys, *out.mutable_wall());
  }
  if (in.tissue) {
    out.mutable_tissue()->set_axis(static_cast<pb::Axis>(in.tissue->axis));
    text::write_keys(*in.tissue, kTissueKeys, *out.mutable_tissue());
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
