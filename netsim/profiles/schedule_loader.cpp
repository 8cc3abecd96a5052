#include "netsim/profiles/schedule_loader.h"

#include "common/base/milliseconds.h"
#include "proto/text/script_text.h"

namespace tandem::netsim {
namespace {

NetworkEvent event_from(const ScriptEventSpec& in) {
  NetworkEvent event{.at = from_milliseconds(in.at_s * 1e3), .clients = in.clients, .outage = in.outage};
  if (!in.up || !in.down) event.direction = in.up ? Direction::kUp : Direction::kDown;
  if (in.rebind) event.rebind = Rebind{from_milliseconds(in.rebind->dead_after_ms)};
  return event;
}

/// Reports errors of a profile at the script line that names the profile. File and line inside the profile are added if
/// known.
void add_profile_errors(const InputError& place, InputErrors found, InputErrors& errors) {
  InputError here = place;
  const bool own_place = !found.empty() && found.front().line > 0;
  here.message = own_place ? "this profile cannot be used:" : found.empty() ? "cannot be used" : found.front().message;
  errors.push_back(std::move(here));
  if (own_place) errors.insert(errors.end(), found.begin(), found.end());
}

}  // namespace

std::expected<std::vector<NetworkEvent>, InputErrors> network_events(std::span<const ScriptEventSpec> events,
                                                                     const FindNetwork& find) {
  std::vector<NetworkEvent> all;
  InputErrors errors;
  for (const ScriptEventSpec& in : events) {
    NetworkEvent& event = all.emplace_back(event_from(in));
    if (!in.profile) continue;
    if (auto link = find(*in.profile)) {
      event.link = std::move(*link);
      event.network = *in.profile;
    } else {
      add_profile_errors(in.profile_place, std::move(link.error()), errors);
    }
  }
  // Final validation by the engine. Errors missed by the schema's rules have no line.
  for (std::size_t i = 0; i < all.size() && errors.empty(); ++i) {
    for (const SpecError& problem : problems(all[i])) {
      const std::string key = "event[" + std::to_string(i) + "]." + problem.key;
      errors.push_back({events[i].profile_place.file, 0, 0, key, "", problem.message});
    }
  }
  if (!errors.empty()) return std::unexpected(std::move(errors));
  return all;
}

std::expected<std::vector<NetworkEvent>, InputErrors> parse_script(std::string_view text, std::string_view file_name,
                                                                   std::span<const std::string> clients,
                                                                   const FindNetwork& find) {
  ScriptReading reading = read_script_text(text, file_name, clients);
  if (!reading.spec) return std::unexpected(std::move(reading.errors));
  auto events = network_events(reading.spec->events, find);
  if (reading.errors.empty()) return events;
  if (!events) {
    // Engine errors have no line and may follow from the errors already reported, so they are removed.
    std::erase_if(events.error(), [](const InputError& error) { return error.line == 0; });
    add_unexplained(reading.errors, std::move(events.error()));
  }
  return std::unexpected(std::move(reading.errors));
}

std::expected<LinkSpec, InputErrors> find_shipped(const std::string& name) {
  auto profile = shipped_profile(name);
  if (!profile) return std::unexpected(std::move(profile.error()));
  return std::move(profile->link);
}

}  // namespace tandem::netsim
