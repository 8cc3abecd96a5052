#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/base/suggestions.h"
#include "common/io/command_line.h"
#include "common/io/print.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/commands/server_commands.h"

namespace tandem::server {
namespace {

struct ScenesArguments {
  std::string print;
  bool json = false;
};

int print_scene(const std::string& name, bool json) {
  const EmbeddedFile* scene = find_shipped_scene(name);
  if (scene == nullptr) {
    io::print_formatted(stderr, "tandem-server scenes: --print %s: no shipped scene of this name; %s\n", name.c_str(),
                        suggest_name(name, shipped_scenes()).c_str());
    return 2;
  }
  if (json) {
    const nlohmann::ordered_json j{{"name", scene->name}, {"summary", scene->summary}, {"text", scene->text}};
    std::printf("%s\n", j.dump(2).c_str());
  } else {
    std::fwrite(scene->text.data(), 1, scene->text.size(), stdout);
  }
  return 0;
}

int scenes_command(const ScenesArguments& arguments) {
  if (!arguments.print.empty()) return print_scene(arguments.print, arguments.json);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const EmbeddedFile& scene : shipped_scenes()) {
    if (arguments.json) {
      list.push_back({{"name", scene.name}, {"summary", scene.summary}});
    } else {
      io::print_formatted(stdout, "%-17.*s %.*s\n", static_cast<int>(scene.name.size()), scene.name.data(),
                          static_cast<int>(scene.summary.size()), scene.summary.data());
    }
  }
  if (arguments.json) std::printf("%s\n", list.dump(2).c_str());
  return 0;
}

}  // namespace

void add_scenes_command(const io::Command& root) {
  const auto [command, arguments] = root.add_command(
      "scenes", "Lists the shipped scenes, or prints one as text: a start for a scene of your own.", scenes_command);
  command.add_option("--print", arguments.print, "the scene to print").value_name("NAME");
  command.add_flag("--json", arguments.json, "for machines: name and summary, with --print also the text");
  command.footer(
      "Examples\n"
      "  tandem-server scenes\n"
      "  tandem-server scenes --print free_motion > mine.textproto\n"
      "  tandem-server run mine.textproto --check");
}

}  // namespace tandem::server
