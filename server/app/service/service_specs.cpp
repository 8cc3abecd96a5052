#include "server/app/service/service_specs.h"

#include <algorithm>
#include <utility>

#include "proto/text/scene_bytes.h"
#include "proto/text/scene_text.h"
#include "server/app/control/session_registry.h"

namespace tandem::server {

ServiceSession spec_of(const SessionOptions& session) {
  ServiceSession spec;
  spec.id = auth::random_bytes<auth::Id16>();
  if (!session.tickets_only) spec.code = make_session_code();
  SceneSpec scene = session.scene;
  // A file may have no duration that ends before its timeline, so the text keeps the scene's own.
  if (session.scene_duration > 0) spec.duration_s = std::exchange(scene.duration, session.scene_duration);
  spec.scene = scene_file_text(scene);
  spec.scene_name = scene.name;
  spec.tickets_only = session.tickets_only;
  spec.restart = session.restart;
  return spec;
}

std::string read_spec(const ServiceSession& spec, SessionOptions& session) {
  auto scene = parse_scene(spec.scene, spec.scene_name + ".textproto");
  if (!scene) return "its scene in the directory has mistakes: " + reply_text(scene.error());
  session.scene = std::move(*scene);
  session.scene_duration = spec.duration_s > 0 ? std::exchange(session.scene.duration, spec.duration_s) : 0;
  session.tickets_only = spec.tickets_only;
  session.restart = spec.restart;
  return {};
}

bool serves(const SessionTable& sessions, const std::string& name) {
  return std::ranges::any_of(sessions.all(), [&](const auto& s) { return s->options().name == name; });
}

std::string joined_endpoints(const directory::EtcdOptions& etcd) {
  std::string text;
  for (const std::string& endpoint : etcd.endpoints) text += (text.empty() ? "" : ", ") + endpoint;
  return text;
}

}  // namespace tandem::server
