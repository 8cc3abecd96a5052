#include "netsim/profiles/profile_loader.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/base/suggestions.h"
#include "proto/text/profile_text.h"

namespace tandem::netsim {
namespace {

/// Returns a minimal recording, used to validate the other parameters while the real one is missing.
SharedRecording<CapacityTrace> stand_in() {
  return std::make_shared<CapacityTrace>(CapacityTrace{{{0, 1}}, std::chrono::milliseconds(1)});
}

constexpr auto kProfiles = sorted_by_name(std::to_array<EmbeddedFile>({
#include "profiles_embedded_data.inc"
}));

}  // namespace

bool supply_capacity(LinkSpec& link, const LinkSpec& recorded) {
  bool used = false;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    RateSpec& rate = link[direction].rate;
    if (!rate.recorded) continue;
    rate.trace = recorded[direction].rate.trace;
    used = true;
  }
  return used;
}

std::expected<Profile, InputErrors> parse_profile(std::string_view text, std::string_view file_name) {
  auto profile = parse_profile_text(text, file_name);
  if (!profile) return profile;
  // Final validation by the engine. Errors missed by the schema's rules (a value rounded to 0 ns) have no line.
  InputErrors errors;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    PathSpec spec = profile->link[direction];
    if (spec.rate.recorded) spec.rate.trace = stand_in();
    for (const SpecError& problem : problems(spec)) {
      errors.push_back(
          {std::string(file_name), 0, 0, std::string(name(direction)) + "." + problem.key, "", problem.message});
    }
  }
  if (!errors.empty()) return std::unexpected(std::move(errors));
  return profile;
}

std::span<const EmbeddedFile> shipped_profiles() noexcept { return kProfiles; }

std::span<const EmbeddedFile> complete_profiles() {
  static const std::vector<EmbeddedFile> all = [] {
    std::vector<EmbeddedFile> some;
    for (const EmbeddedFile& profile : shipped_profiles()) {
      const auto read = shipped_profile(profile.name);
      if (read && !read->capacity_file) some.push_back(profile);
    }
    return some;
  }();
  return all;
}

std::expected<Profile, InputErrors> shipped_profile(std::string_view name) {
  std::vector<std::string> names;
  for (const EmbeddedFile& profile : shipped_profiles()) {
    if (profile.name == name) return parse_profile(profile.text, std::string(name) + ".textproto");
    names.emplace_back(profile.name);
  }
  return std::unexpected(InputErrors{{"", 0, 0, "", "",
                                      "no profile is called \"" + std::string(name) + "\"; " + suggest(name, names) +
                                          "; a file needs its path or its ending, such as my.textproto"}});
}

}  // namespace tandem::netsim
