#include "server/app/process/session_creation.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "common/auth/enrolment.h"
#include "common/base/format.h"
#include "common/base/sanitize.h"
#include "common/base/suggestions.h"
#include "proto/io/scene_file.h"
#include "proto/rpc/rpc_texts.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;

/// A scene by its name, which has neither slash nor dot, so that it names no file outside the folder.
std::expected<SceneSpec, InputErrors> named_scene(const std::string& name, const std::string& folder) {
  const std::string file = name + ".textproto";
  std::error_code error;
  if (!folder.empty() && std::filesystem::is_regular_file(folder + "/" + file, error)) {
    const auto text = read_text_file(folder + "/" + file);
    if (!text) return std::unexpected(text.error());
    return parse_scene(*text, file);
  }
  if (const auto* const shipped = find_shipped_scene(name)) return parse_scene(shipped->text, file);
  std::vector<std::string> names;
  for (const auto& shipped : shipped_scenes()) names.emplace_back(shipped.name);
  return std::unexpected(InputErrors{{name, 0, 0, "", "", "is no scene of this server; " + suggest(name, names)}});
}

/// Adds the durations of the scenes, and their seats as long as those of a whole scene fit. A scene with mistakes has
/// neither.
void describe_scenes(const std::string& folder, rpc::SceneList& list) {
  list.durations_s.assign(list.scenes.size(), 0);
  bool fits = true;
  for (std::size_t i = 0; i < list.scenes.size(); ++i) {
    const auto scene = named_scene(list.scenes[i], folder);
    if (!scene) continue;
    if (!scene->endless()) list.durations_s[i] = scene->duration;
    fits = fits && list.seats.size() + scene->seats.size() <= rpc::kSceneSeatsMax;
    if (!fits) continue;
    for (const SeatSpec& seat : scene->seats)
      list.seats.push_back({static_cast<std::uint32_t>(i), seat.name, access_role(seat.role)});
  }
}

}  // namespace

std::string reply_text(const InputErrors& errors) {
  constexpr std::size_t kRest = 24;  // for the number of the others
  std::string text;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::string next = (i == 0 ? "" : "; ") + sanitize(to_text(errors[i]));
    if (text.size() + next.size() + kRest > rpc::kTextMax) {
      if (i == 0) text = truncate_utf8(next, rpc::kTextMax - kRest);
      const std::size_t rest = errors.size() - std::max<std::size_t>(i, 1);
      return rest == 0 ? text : text + format("; and %zu more", rest);
    }
    text += next;
  }
  return text;
}

std::expected<SessionOptions, ErrorReply> created_session_options(const rpc::CreateSession& wanted,
                                                                  const std::string& scenes) {
  if (auth::canonical_session_code(wanted.name))
    return std::unexpected(ErrorReply{ErrorCode::kBadFrame,
                                      "name \"" + wanted.name +
                                          "\" has the form of a session code (10 letters and digits), so no client "
                                          "could join by it; choose a shorter "
                                          "one",
                                      0});
  auto scene = wanted.scene.empty() ? parse_scene(wanted.scene_text, wanted.name + ".textproto")
                                    : named_scene(wanted.scene, scenes);
  if (!scene) return std::unexpected(ErrorReply{ErrorCode::kBadFrame, reply_text(scene.error()), 0});
  for (const rpc::SeatHolder& holder : wanted.holders)
    if (!holder.seat.empty() && std::ranges::find(scene->seats, holder.seat, &SeatSpec::name) == scene->seats.end()) {
      std::string names;
      for (const SeatSpec& seat : scene->seats) names += (names.empty() ? "" : ", ") + seat.name;
      return std::unexpected(
          ErrorReply{ErrorCode::kNoSeat, "the scene has no seat " + holder.seat + "; seats: " + names, 0});
    }
  SessionOptions options{.name = wanted.name, .tickets_only = wanted.tickets_only};
  options.scene = std::move(*scene);
  return options;
}

rpc::SceneList list_scenes(const std::string& scenes) {
  constexpr std::size_t kEntriesMax = 4096;
  std::set<std::string> names;
  for (const auto& shipped : shipped_scenes()) names.emplace(shipped.name);
  rpc::SceneList list;
  std::error_code error;
  if (!scenes.empty()) {
    std::size_t read = 0;
    for (std::filesystem::directory_iterator file(scenes, error), end; !error && file != end; file.increment(error)) {
      list.more = ++read > kEntriesMax;
      if (list.more) break;
      const std::filesystem::path path = file->path().filename();
      std::error_code ignored;
      if (path.extension() == ".textproto" && rpc::is_name(path.stem().string()) && file->is_regular_file(ignored))
        names.insert(path.stem().string());
    }
  }
  for (const std::string& name : names) {
    if (list.scenes.size() == rpc::kScenesMax) {
      list.more = true;
      break;
    }
    list.scenes.push_back(name);
  }
  describe_scenes(scenes, list);
  return list;
}

}  // namespace tandem::server
