#include "client/app/recording_text.h"

#include <nlohmann/json.hpp>

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::client {
namespace {

std::string recorders(const rpc::StatusRecording& recording) {
  std::string by = recording.by_server ? "the server" : "";
  if (recording.by_server && recording.pseudonyms) by += ", without names,";
  if (recording.by_recorders == 0) return by.ends_with(',') ? by.substr(0, by.size() - 1) : by;
  return by + (by.empty() ? "" : " and ") +
         format("%u recorder%s", recording.by_recorders, recording.by_recorders == 1 ? "" : "s");
}

}  // namespace

std::string recording_text(const rpc::StatusRecording& recording) {
  std::string text = "RECORDED by " + recorders(recording);
  if (recording.dropped > 0)
    text += format("; %llu ticks dropped so far", static_cast<unsigned long long>(recording.dropped));
  if (!recording.trouble.empty()) text += "; ticks are dropped now: " + sanitize(recording.trouble);
  return text;
}

std::string recording_brief(const rpc::StatusRecording& recording) {
  return recording.trouble.empty() ? "RECORDED" : "RECORDED with gaps";
}

std::string recording_change_text(const std::optional<rpc::StatusRecording>& before,
                                  const std::optional<rpc::StatusRecording>& now) {
  if (!now) return before ? "the session is no longer recorded" : "";
  const bool same = before && before->by_server == now->by_server && before->by_recorders == now->by_recorders &&
                    before->pseudonyms == now->pseudonyms && before->trouble.empty() == now->trouble.empty();
  return same ? "" : recording_text(*now);
}

std::string recording_json(const std::optional<rpc::StatusRecording>& recording) {
  using Json = nlohmann::ordered_json;
  if (!recording) return "null";
  return Json{{"by_server", recording->by_server},
              {"by_recorders", recording->by_recorders},
              {"pseudonyms", recording->pseudonyms},
              {"dropped_ticks", recording->dropped},
              {"trouble", recording->trouble.empty() ? Json(nullptr) : Json(sanitize(recording->trouble))}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tandem::client
