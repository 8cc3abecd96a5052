#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "netsim/app/proxy_command.h"
#include "netsim/profiles.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

struct ProfilesArguments {
  std::string name;
  bool json = false;
};

Json to_json(const Profile& profile) {
  Json json;
  json["name"] = profile.name;
  json["version"] = profile.version;
  json["summary"] = profile.summary;
  json["sources"] = profile.sources;
  json["checks"] = Json::array();
  for (const ProfileCheck& check : profile.checks) {
    json["checks"].push_back({{"direction", name(check.direction)},
                              {"p5_ms", check.delay_ms[0]},
                              {"p50_ms", check.delay_ms[1]},
                              {"p95_ms", check.delay_ms[2]},
                              {"p99_ms", check.delay_ms[3]}});
  }
  return json;
}

int profiles_command(const ProfilesArguments& arguments) {
  std::vector<Profile> profiles;
  if (arguments.name.empty()) {
    for (const ShippedProfile& shipped : shipped_profiles()) {
      // Profiles are tested with the program; one that cannot be read would be our mistake, and is said so.
      if (auto profile = shipped_profile(shipped.name)) profiles.push_back(std::move(*profile));
    }
  } else {
    auto profile = shipped_profile(arguments.name);
    if (!profile) {
      std::fprintf(stderr, "tandem-netsim profiles: %s", to_text(profile.error()).c_str());
      return 2;
    }
    profiles.push_back(std::move(*profile));
  }
  if (arguments.json) {
    Json json = Json::array();
    for (const Profile& profile : profiles) json.push_back(to_json(profile));
    std::printf("%s\n", (arguments.name.empty() ? json : json.front()).dump(2).c_str());
    return 0;
  }
  if (!arguments.name.empty()) {
    for (const ShippedProfile& shipped : shipped_profiles()) {
      if (shipped.name == arguments.name) std::fwrite(shipped.text.data(), 1, shipped.text.size(), stdout);
    }
    return 0;
  }
  for (const Profile& profile : profiles) {
    std::printf("%-18s %s\n", profile.name.c_str(), profile.summary.c_str());
  }
  return 0;
}

}  // namespace

void add_profiles_command(CLI::App& root, std::function<int()>& action) {
  const auto arguments = std::make_shared<ProfilesArguments>();
  CLI::App* const command = root.add_subcommand(
      "profiles", "Lists the named networks, or prints one as text: a start for a file of your own.");
  command->add_option("NAME", arguments->name, "the profile to print");
  command->add_flag("--json", arguments->json, "for machines: name, version, summary, sources, delay quantiles");
  command->callback([arguments, &action] { action = [arguments] { return profiles_command(*arguments); }; });
}

}  // namespace tandem::netsim
