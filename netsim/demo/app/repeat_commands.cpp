#include "netsim/demo/app/repeat_commands.h"

#include <sstream>

#include "netsim/demo/app/child_process.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {
namespace {

constexpr const char *kServer = "127.0.0.1:47000", *kNetwork = "127.0.0.1:47001";

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

}  // namespace

std::string program_prefix(const std::filesystem::path& folder, const std::filesystem::path& here,
                           const std::string& search_path) {
  std::istringstream places(search_path);
  for (std::string place; std::getline(places, place, ':');) {
    std::error_code error;
    if (!place.empty() && std::filesystem::equivalent(place, folder, error) && !error) return "";
  }
  const auto relative = folder.lexically_relative(here);
  const bool below = !relative.empty() && *relative.begin() != "..";
  return (below ? relative : folder).string() + "/";
}

std::vector<std::string> impairment_options(Setting setting) {
  if (setting != Setting::kBadNetwork) return {"--profile", "ideal"};
  const auto text = [](double value) { return plot::number_text(value, 0); };
  return {"--delay", text(kBadDelayMs),     "--jitter", text(kBadJitterMs),
          "--loss",  text(kBadLossPercent), "--seed",   std::to_string(kSeedNumber)};
}

std::vector<std::string> virtual_commands(const RunPlan& plan, const std::string& prefix) {
  std::vector<std::string> words{prefix + "tandem-netsim", "run", std::string(plan.scene)};
  if (plan.setting == Setting::kBadNetwork) append(words, impairment_options(plan.setting));
  const std::string name(plan.name);
  append(words, {"--json", name + ".json", "--trace", name + ".csv"});
  return {command_text(words)};
}

std::vector<std::string> real_commands(const RunPlan& plan, const std::string& prefix) {
  const std::string name(plan.name);
  std::vector<std::string> proxy{prefix + "tandem-netsim", "proxy", "--listen", kNetwork, "--to", kServer};
  append(proxy, impairment_options(plan.setting));
  append(proxy, {"--duration", "120"});
  std::vector<std::string> commands{command_text({prefix + "tandem-server", "run", std::string(plan.scene), "--listen",
                                                  kServer, "--json", name + ".json", "--trace", name + ".csv"}),
                                    command_text(proxy)};
  for (const char* seat : {"trainer", "trainee"})
    commands.push_back(command_text({prefix + "tandem-client", "join", "--server", kNetwork, "--seat", seat, "--device",
                                     "sim", "--trace", name + "-" + seat + ".csv"}));
  return commands;
}

}  // namespace tandem::netsim::demo
