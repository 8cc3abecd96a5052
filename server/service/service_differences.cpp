#include "server/service/service_differences.h"

#include <algorithm>
#include <string_view>

#include "common/base/format.h"
#include "common/base/sanitize.h"

namespace tandem::server {

namespace {

constexpr std::size_t kLineShown = 60;  // characters of a scene's line

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string shown_line(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  return line.empty() ? "nothing" : "`" + sanitize(std::string(line), kLineShown) + "`";
}

std::string scene_difference(const ServiceSession& configured, const ServiceSession& running) {
  std::string_view here = configured.scene, there = running.scene;
  while (!here.empty() || !there.empty()) {
    const std::string_view a = take_line(here), b = take_line(there);
    if (a == b) continue;
    return "scene " + sanitize(configured.scene_name, kLineShown) + " (" + shown_line(a) + " here, " + shown_line(b) +
           " in the service)";
  }
  return "scene";
}

std::string seconds_text(double s) { return s > 0 ? format("%.10g s", s) : "that of the scene"; }

}  // namespace

std::string difference_text(const ServiceSession& configured, const ServiceSession& running) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (configured.scene_name != running.scene_name)
    add("scene " + sanitize(configured.scene_name, kLineShown) + " here, " + sanitize(running.scene_name, kLineShown) +
        " in the service");
  else if (configured.scene != running.scene)
    add(scene_difference(configured, running));
  if (configured.duration_s != running.duration_s)
    add("duration " + seconds_text(configured.duration_s) + " here, " + seconds_text(running.duration_s) +
        " in the service");
  const auto add_flag = [&](const char* name, bool here, bool there) {
    if (here != there)
      add(std::string(name) + " " + (here ? "true" : "false") + " here, " + (there ? "true" : "false") +
          " in the service");
  };
  add_flag("tickets_only", configured.tickets_only, running.tickets_only);
  add_flag("restart", configured.restart, running.restart);
  return text;
}

std::vector<ServiceDifferences::Difference> ServiceDifferences::update(const ServiceMember& member) {
  std::vector<Difference> found;
  std::erase_if(waiting_, [&](const auto& configured) {
    const auto& [name, spec] = configured;
    const std::string owner = member.directory().owner_of(name);
    const ServiceSession* const running = member.directory().catalogue.find(name);
    if (owner.empty() || owner == server_ || running == nullptr) return false;
    if (const std::string what = difference_text(spec, *running); !what.empty())
      found.push_back(
          {name, "session " + name +
                     " differs in the configuration of this server from the session that the "
                     "service runs at server " +
                     owner + ": " + what +
                     ". The session of the service holds, also if this server takes it over. Give all servers of "
                     "the service the same `session` blocks; a changed one takes effect when the session has "
                     "ended, or all servers have, and one of them starts again"});
    return true;
  });
  return found;
}

}  // namespace tandem::server
