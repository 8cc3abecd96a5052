#include "netsim/app/profile_source.h"

#include <algorithm>
#include <filesystem>

#include "common/base/format.h"
#include "netsim/profiles/app/capacity_file.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/profiles/network_csv.h"

namespace tandem::netsim {
namespace {

/// Returns whether a name is a path: an existing file, or a name with a slash or an extension.
bool is_file(const std::string& name) {
  return std::filesystem::is_regular_file(name) || name.find('/') != std::string::npos ||
         name.find('.') != std::string::npos;
}

std::expected<ProfileSource, std::string> from_profile(std::expected<Profile, InputErrors> profile,
                                                       const std::string& file, std::string_view text) {
  if (!profile) return std::unexpected(lines_of(profile.error()));
  return ProfileSource{.profile = std::move(*profile), .file = file, .text = std::string(text)};
}

}  // namespace

std::expected<ProfileSource, std::string> load_profile_source(const std::string& name_or_file, Duration interval) {
  if (!is_file(name_or_file)) {
    const auto shipped = std::ranges::find(shipped_profiles(), name_or_file, &EmbeddedFile::name);
    return from_profile(shipped_profile(name_or_file), "",
                        shipped == shipped_profiles().end() ? std::string_view{} : shipped->text);
  }
  const auto text = read_network_file(name_or_file);
  if (!text) return std::unexpected(text.error());
  const bool capacity = looks_like_capacity(*text);
  if (!capacity && !name_or_file.ends_with(".csv"))
    return from_profile(parse_profile(*text, name_or_file), name_or_file, *text);
  ProfileSource subject{.profile = {}, .recording = true};
  subject.profile.name = std::filesystem::path(name_or_file).stem().string();
  if (capacity) {
    auto recorded = parse_capacity_file(*text, name_or_file);
    if (!recorded) return std::unexpected(recorded.error());
    subject.profile.summary = std::move(recorded->description);
    subject.profile.link = std::move(recorded->link);
    return subject;
  }
  auto recorded = parse_network_csv(*text, name_or_file, interval);
  if (!recorded) return std::unexpected(lines_of(recorded.error()));
  subject.profile.summary = format("recording of %.1f s in %zu rows, %zu lost; then from the start again",
                                   seconds(recorded->length), recorded->rows, recorded->lost);
  subject.profile.link = std::move(recorded->link);
  subject.notes = notes_of(*recorded, name_or_file);
  subject.plays_interval = !recorded->timed;
  return subject;
}

std::string complete(ProfileSource& subject, const std::string& capacity) {
  if (subject.recording) return capacity.empty() ? "" : "--capacity: belongs to a profile that plays it";
  const auto words = complete_capacity(subject.profile, subject.file, capacity);
  if (!words) return words.error();
  if (words->empty() && !capacity.empty()) {
    return "--capacity: profile " + subject.profile.name + " plays no recorded capacity; 4g-trace does";
  }
  if (!words->empty()) subject.notes.push_back(*words);
  return "";
}

}  // namespace tandem::netsim
