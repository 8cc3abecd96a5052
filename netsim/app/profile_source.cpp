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

std::string lines_of(const InputErrors& errors) {
  std::string text = to_text(errors);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace

std::expected<ProfileSource, std::string> load_profile_source(const std::string& name_or_file, Duration interval) {
  ProfileSource subject;
  if (!is_file(name_or_file)) {
    auto profile = shipped_profile(name_or_file);
    if (!profile) return std::unexpected(lines_of(profile.error()));
    subject.profile = std::move(*profile);
    for (const ShippedProfile& shipped : shipped_profiles()) {
      if (shipped.name == name_or_file) subject.text = std::string(shipped.text);
    }
    return subject;
  }
  auto text = read_network_file(name_or_file);
  if (!text) return std::unexpected(text.error());
  if (looks_like_capacity(*text)) {
    auto recorded = parse_capacity_file(*text, name_or_file);
    if (!recorded) return std::unexpected(recorded.error());
    subject.recording = true;
    subject.profile.name = std::filesystem::path(name_or_file).stem().string();
    subject.profile.summary = std::move(recorded->description);
    subject.profile.link = std::move(recorded->link);
    return subject;
  }
  if (!name_or_file.ends_with(".csv")) {
    auto profile = parse_profile(*text, name_or_file);
    if (!profile) return std::unexpected(lines_of(profile.error()));
    subject.profile = std::move(*profile);
    subject.file = name_or_file;
    subject.text = std::move(*text);
    return subject;
  }
  auto recorded = parse_network_csv(*text, name_or_file, interval);
  if (!recorded) return std::unexpected(lines_of(recorded.error()));
  subject.recording = true;
  subject.profile.name = std::filesystem::path(name_or_file).stem().string();
  subject.profile.summary = format("recording of %.1f s in %zu rows, %zu lost; then from the start again",
                                   seconds(recorded->length), recorded->rows, recorded->lost);
  for (std::string& note : notes_of(*recorded, name_or_file)) subject.notes.push_back(std::move(note));
  subject.plays_interval = !recorded->timed;
  subject.profile.link = std::move(recorded->link);
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
