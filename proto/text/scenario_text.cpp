#include "proto/text/scenario_text.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include "proto/schema/limits.pb.h"
#include "proto/schema/scenario.pb.h"
#include "proto/schema/script.pb.h"
#include "proto/text/message_keys.h"
#include "proto/text/script_events.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageKey;
using text::MessageValidator;

using Network = ScenarioNetworkSpec;
constexpr std::array<MessageKey<Network>, 6> kNetworkKeys{{{"delay_ms", &Network::delay_ms},
                                                           {"jitter_ms", &Network::jitter_ms},
                                                           {"loss_percent", &Network::loss_percent},
                                                           {"duplicate_percent", &Network::duplicate_percent},
                                                           {"reorder_percent", &Network::reorder_percent},
                                                           {"trace_interval_ms", &Network::trace_interval_ms}}};

ScenarioLocation place_of(const MessageValidator& validator, const std::string& key) {
  const text::SourceLocation place = validator.location(key);
  return {place.line, place.column, key, place.value};
}

ScenarioName name_of(const std::string& name, const MessageValidator& validator, const std::string& key) {
  return {name, place_of(validator, key)};
}

std::vector<ScenarioName> names_of(const google::protobuf::RepeatedPtrField<std::string>& names,
                                   const MessageValidator& validator, const std::string& parent,
                                   std::string_view field) {
  std::vector<ScenarioName> out;
  for (int i = 0; i < names.size(); ++i) out.push_back(name_of(names[i], validator, child_path(parent, field, i)));
  return out;
}

ScenarioNetworkSpec network_from(const pb::ScenarioNetwork& in, MessageValidator& validator, const std::string& key) {
  ScenarioNetworkSpec out;
  out.place = place_of(validator, key);
  if (in.has_profile()) {
    out.profile = name_of(in.profile(), validator, child_path(key, "profile"));
    if (in.profile().empty()) validator.error(child_path(key, "profile"), "is empty; name a profile or a file");
  }
  text::read_keys(in, kNetworkKeys, out);
  if (in.has_trace_interval_ms() && !in.profile().ends_with(".csv"))
    validator.error(child_path(key, "trace_interval_ms"), "is for a profile that is a recording, a .csv file");
  return out;
}

ScenarioEndpointSpec endpoint_from(const pb::ScenarioEndpoint& in, MessageValidator& validator,
                                   const std::string& key) {
  ScenarioEndpointSpec out;
  out.place = place_of(validator, key);
  out.seats = names_of(in.seat(), validator, key, "seat");
  out.offset_ms = in.offset_ms();
  out.drift_ppm = in.drift_ppm();
  out.wake = static_cast<ScenarioEndpointSpec::Wake>(in.wake());
  out.late_max_ms = in.late_max_ms();
  const bool uniform = in.wake() == pb::ScenarioEndpoint::UNIFORM;
  // A value that is present but unreadable does not count as missing.
  if ((in.has_late_max_ms() || validator.is_set(child_path(key, "late_max_ms"))) != uniform) {
    validator.error(child_path(key, uniform ? "wake" : "late_max_ms"),
                    uniform ? "UNIFORM needs late_max_ms" : "is for wake: UNIFORM");
  }
  double before = -1;
  for (int i = 0; i < in.step_size(); ++i) {
    out.steps.push_back({in.step(i).at_s(), in.step(i).by_ms()});
    if (in.step(i).at_s() <= before)
      validator.error(child_path(child_path(key, "step", i), "at_s"), "steps must ascend in time");
    before = in.step(i).at_s();
  }
  return out;
}

/// Converts every Range of a block of limits, in the order of the schema.
/// @param common  seats, phase or tools; the same for all of them
void limits_from(const google::protobuf::Message& in, const ScenarioLimitSpec& common, MessageValidator& validator,
                 const std::string& key, std::vector<ScenarioLimitSpec>& out) {
  const auto& reflection = *in.GetReflection();
  const auto& descriptor = *in.GetDescriptor();
  bool any = false;
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const auto& field = *descriptor.field(i);
    if (field.message_type() != pb::Range::descriptor() || !reflection.HasField(in, &field)) continue;
    any = true;
    const std::string metric_key = child_path(key, field.name());
    const auto& range = static_cast<const pb::Range&>(reflection.GetMessage(in, &field));
    ScenarioLimitSpec limit = common;
    limit.metric = field.name();
    const std::string& unit = field.options().GetExtension(pb::limit).unit();
    if (unit != "1") limit.unit = unit;
    limit.place = place_of(validator, metric_key);
    if (range.has_min()) limit.min = range.min();
    if (range.has_max()) limit.max = range.max();
    if (range.has_min()) validator.check_number(field, range.min(), child_path(metric_key, "min"));
    if (range.has_max()) validator.check_number(field, range.max(), child_path(metric_key, "max"));
    if (!limit.min && !limit.max) validator.error(metric_key, "needs min, max or both: the range of the number");
    if (limit.min && limit.max && *limit.min > *limit.max)
      validator.error(child_path(metric_key, "min"),
                      "is above max = " + text::number_text(*limit.max) + ": nothing can pass");
    out.push_back(std::move(limit));
  }
  if (!any) validator.error(key, "limits nothing; name a quantity and its range, such as tracking_rms_m { max: 0.01 }");
}

void all_limits_from(const pb::Scenario& in, MessageValidator& validator, std::vector<ScenarioLimitSpec>& out) {
  for (int i = 0; i < in.seat_limits_size(); ++i) {
    const std::string key = child_path("", "seat_limits", i);
    ScenarioLimitSpec common;
    common.names = names_of(in.seat_limits(i).seat(), validator, key, "seat");
    if (in.seat_limits(i).has_phase())
      common.phase = name_of(in.seat_limits(i).phase(), validator, child_path(key, "phase"));
    limits_from(in.seat_limits(i), common, validator, key, out);
  }
  for (int i = 0; i < in.tool_limits_size(); ++i) {
    const std::string key = child_path("", "tool_limits", i);
    ScenarioLimitSpec common;
    common.of = ScenarioLimitSpec::Of::kTool;
    common.names = names_of(in.tool_limits(i).tool(), validator, key, "tool");
    limits_from(in.tool_limits(i), common, validator, key, out);
  }
  if (in.has_session_limits()) {
    ScenarioLimitSpec common;
    common.of = ScenarioLimitSpec::Of::kSession;
    limits_from(in.session_limits(), common, validator, "session_limits", out);
  }
  if (in.has_feel()) {
    ScenarioLimitSpec common;
    common.of = ScenarioLimitSpec::Of::kFeel;
    limits_from(in.feel(), common, validator, "feel", out);
  }
}

std::string stem(std::string_view file) {
  if (const auto slash = file.rfind('/'); slash != std::string_view::npos) file.remove_prefix(slash + 1);
  return std::string(file.substr(0, file.find('.')));
}

}  // namespace

ScenarioReading read_scenario_text(std::string_view text, std::string_view file_name) {
  MessageValidator validator{file_name};
  pb::Scenario in;
  const bool enough = text::read_document(text, file_name, in, validator);
  ScenarioReading reading{.spec = {}, .errors = validator.take()};
  if (!enough) return reading;

  ScenarioSpec& out = reading.spec.emplace();
  out.name = stem(file_name);
  out.file = file_name;
  out.summary = in.summary();
  out.scene = name_of(in.scene(), validator, "scene");
  if (in.scene().empty()) validator.error("scene", "is empty; name a shipped scene or a file");
  if (in.has_duration_s()) out.duration_s = in.duration_s();
  if (in.has_seed()) out.seed = in.seed();
  if (in.has_seeds()) out.seeds = in.seeds();
  if (in.has_channel()) out.channel = static_cast<LawKind>(in.channel());
  if (in.has_mfs()) out.mfs = static_cast<MfsMode>(in.mfs());
  if (in.has_network()) out.network = network_from(in.network(), validator, "network");
  for (int i = 0; i < in.seat_network_size(); ++i) {
    const std::string key = child_path("", "seat_network", i);
    if (in.seat_network(i).seat_size() == 0) validator.error(key, "needs seat: the seat that uses this network");
    out.seat_networks.push_back({names_of(in.seat_network(i).seat(), validator, key, "seat"),
                                 network_from(in.seat_network(i).network(), validator, child_path(key, "network"))});
  }
  for (int i = 0; i < in.event_size(); ++i) {
    const std::string key = child_path("", "event", i);
    const std::vector<std::string> any(in.event(i).client().begin(),
                                       in.event(i).client().end());  // seats: checked against the scene later
    ScriptEventSpec event = script_event_from(in.event(i), validator, key, any);
    event.profile_place.file = file_name;
    out.events.push_back({std::move(event), names_of(in.event(i).client(), validator, key, "client")});
  }
  for (int i = 0; i < in.hand_size(); ++i) {
    const std::string key = child_path("", "hand", i);
    out.hands.push_back({name_of(in.hand(i).seat(), validator, child_path(key, "seat")),
                         name_of(in.hand(i).motion(), validator, child_path(key, "motion"))});
  }
  for (int i = 0; i < in.fault_size(); ++i) {
    const std::string key = child_path("", "fault", i);
    const pb::ScenarioFault& fault = in.fault(i);
    out.faults.push_back({pb::ScenarioFault::Kind_Name(fault.kind()), names_of(fault.seat(), validator, key, "seat"),
                          fault.at_s(), fault.for_ms(), place_of(validator, key)});
    const bool of_server =
        fault.kind() == pb::ScenarioFault::SERVER_LATE || fault.kind() == pb::ScenarioFault::SERVER_RESTART;
    if (of_server && fault.seat_size() > 0)
      validator.error(child_path(key, "seat", 0),
                      pb::ScenarioFault::Kind_Name(fault.kind()) + " concerns the server, no seat");
  }
  for (int i = 0; i < in.endpoint_size(); ++i)
    out.endpoints.push_back(endpoint_from(in.endpoint(i), validator, child_path("", "endpoint", i)));
  all_limits_from(in, validator, out.limits);
  add_unexplained(reading.errors, validator.take());
  return reading;
}

std::expected<ScenarioSpec, InputErrors> parse_scenario_text(std::string_view text, std::string_view file_name) {
  ScenarioReading reading = read_scenario_text(text, file_name);
  if (!reading.errors.empty() || !reading.spec) return std::unexpected(std::move(reading.errors));
  return std::move(*reading.spec);
}

}  // namespace tandem
