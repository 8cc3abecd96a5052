#include "proto/text/script_text.h"

#include <algorithm>
#include <charconv>

#include "common/base/suggestions.h"
#include "proto/schema/script.pb.h"
#include "proto/text/profile_outage.h"
#include "proto/text/script_events.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;

constexpr int kArrivalsMax = 1'000'000'000;

bool is_arrival(const std::string& name) {
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc{} && end == name.data() + name.size() && number >= 1 && number <= kArrivalsMax &&
         name.front() != '0' && name.front() != '+';
}

void check_clients(const pb::ScriptEvent& in, MessageValidator& validator, const std::string& key,
                   std::span<const std::string> clients) {
  for (int i = 0; i < in.client_size(); ++i) {
    const std::string& name = in.client(i);
    const std::string path = child_path(key, "client", i);
    if (clients.empty()) {
      if (!is_arrival(name)) validator.error(path, "must be a whole number from 1: clients in order of arrival");
    } else if (std::ranges::find(clients, name) == clients.end()) {
      validator.error(path, "no such client; " + suggest(name, clients));
    }
    if (std::find(in.client().begin(), in.client().begin() + i, name) != in.client().begin() + i) {
      validator.error(path, "is named twice");
    }
  }
}

netsim::OutageSpec script_outage_from(const pb::ScriptEvent& in, MessageValidator& validator, const std::string& key) {
  pb::ProfileOutage outage;
  outage.set_start_s(in.at_s());
  outage.set_length_ms(in.outage_ms());
  if (in.has_mode()) outage.set_mode(in.mode());
  if (in.has_direction()) outage.set_direction(in.direction());
  if (in.has_hold_bytes()) outage.set_hold_bytes(in.hold_bytes());
  return netsim::outage_from(outage, validator, key);
}

}  // namespace

ScriptEventSpec script_event_from(const pb::ScriptEvent& in, MessageValidator& validator, const std::string& key,
                                  std::span<const std::string> clients) {
  ScriptEventSpec event;
  event.at_s = in.at_s();
  check_clients(in, validator, key, clients);
  event.clients.assign(in.client().begin(), in.client().end());
  event.up = in.direction() != pb::ProfileOutage::DOWN;
  event.down = in.direction() != pb::ProfileOutage::UP;
  const int kinds = (in.has_outage_ms() ? 1 : 0) + (in.has_profile() ? 1 : 0) + (in.has_rebind() ? 1 : 0);
  if (kinds != 1) validator.error(key, "needs exactly one of outage_ms, profile, rebind");
  if (in.has_outage_ms()) {
    event.outage = script_outage_from(in, validator, key);
  } else {
    for (const auto& [given, name] : {std::pair{in.has_mode(), "mode"}, {in.has_hold_bytes(), "hold_bytes"}}) {
      if (given) validator.error(child_path(key, name), "belongs to outage_ms");
    }
  }
  if (in.has_profile()) {
    event.profile = in.profile();
    const std::string path = child_path(key, "profile");
    const text::SourceLocation place = validator.location(path);
    event.profile_place = {"", place.line, place.column, path, place.value, ""};
    if (in.profile().empty()) validator.error(path, "is empty: the name of a profile, or a file");
  }
  if (in.has_rebind()) {
    event.rebind = ScriptRebind{in.rebind().dead_after_ms()};
    if (in.has_direction()) {
      validator.error(child_path(key, "direction"), "not with rebind: an address belongs to both directions");
    }
  }
  return event;
}

ScriptReading read_script_text(std::string_view text, std::string_view file_name,
                               std::span<const std::string> clients) {
  MessageValidator validator{file_name};
  pb::NetworkScript in;
  const bool enough = text::read_document(text, file_name, in, validator);
  ScriptReading reading{.spec = {}, .errors = validator.take()};
  if (!enough) return reading;
  ScriptSpec& script = reading.spec.emplace();
  for (int i = 0; i < in.event_size(); ++i) {
    ScriptEventSpec& event =
        script.events.emplace_back(script_event_from(in.event(i), validator, child_path("", "event", i), clients));
    event.profile_place.file = file_name;
  }
  // Rules between values apply only to values that are in range.
  add_unexplained(reading.errors, validator.take());
  return reading;
}

std::expected<ScriptSpec, InputErrors> parse_script_text(std::string_view text, std::string_view file_name,
                                                         std::span<const std::string> clients) {
  ScriptReading reading = read_script_text(text, file_name, clients);
  if (!reading.errors.empty() || !reading.spec) return std::unexpected(std::move(reading.errors));
  return std::move(*reading.spec);
}

}  // namespace tandem
