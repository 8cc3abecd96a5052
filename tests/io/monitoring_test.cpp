// Alert rules and dashboard of server/package/monitoring against the metrics of a running server.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "tests/io/metrics_page.h"
#include "tests/io/programs.h"
#include "tests/server/app/monitor/idle_server.h"

namespace tandem::test {
namespace {

using Labels = std::set<std::string>;
using Metrics = std::map<std::string, Labels>;  ///< labels by name

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(TANDEM_SOURCE_DIR) + "/server/package/monitoring/" + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void add_labels(const std::string& list, Labels& labels) {
  static const std::regex label(R"re((\w+)=~?\\?"|(\w+)!=)re");
  for (std::sregex_iterator at(list.begin(), list.end(), label), end; at != end; ++at)
    labels.insert((*at)[1].matched ? (*at)[1] : (*at)[2]);
}

/// Names and labels that follow them directly.
Metrics named_in(const std::string& text) {
  static const std::regex metric(R"re(\b(tandem_[a-z_]+)(\{[^}]*\})?)re");
  Metrics found;
  for (std::sregex_iterator at(text.begin(), text.end(), metric), end; at != end; ++at)
    add_labels((*at)[2], found[(*at)[1]]);
  return found;
}

/// Adds the metrics of a member of a service.
Metrics with_service(Metrics metrics) {
  const server::ServiceStatus status = server::test::status_of_member();
  metrics.merge(named_in(server::test::IdleServer{}.page("/metrics", &status).body));
  return metrics;
}

/// The metrics page of a server with two seats that records, once the recording has begun.
Metrics served() {
  const Folder folder;
  Process host = hosting("one_axis", {"--metrics", "127.0.0.1:0", "--record", folder.file("a.mcap")});
  std::string at = host.after("metrics on http://");
  at = at.substr(0, at.find('/'));
  const Process trainer = client(address_of(host), "trainer");
  std::string all;
  for (int attempt = 0; attempt < 300; ++attempt) {
    all = page(at);
    if (all.find("tandem_recording_failing") != std::string::npos &&
        all.find("tandem_rtt_seconds") != std::string::npos)
      return named_in(all);
    std::this_thread::sleep_for(std::chrono::milliseconds{100});
  }
  ADD_FAILURE() << "no recording, or no seat: " << all;
  return {};
}

TEST(Monitoring, NamesMetricsAndLabelsThatTheServerHas) {
  const Metrics metrics = with_service(served());
  ASSERT_GT(metrics.size(), 30u);
  for (const char* file : {"alerts.yml", "dashboard.json"}) {
    const Metrics used = named_in(text_of(file));
    EXPECT_GE(used.size(), 15u) << file;
    for (const auto& [name, labels] : used) {
      const auto found = metrics.find(name);
      if (found == metrics.end()) {
        ADD_FAILURE() << file << ": the server has no metric " << name;
        continue;
      }
      for (const std::string& label : labels)
        EXPECT_TRUE(label == "instance" || found->second.contains(label))  // Prometheus adds `instance`
            << file << ": " << name << " has no label " << label;
    }
  }
}

TEST(Monitoring, FindsAWrongNameAndAWrongLabel) {
  const Metrics found =
      named_in(R"({"expr": "sum(tandem_shed_level{instance=~\"$i\", level!=\"2\"}) / tandem_x_total"})");
  EXPECT_EQ(found, (Metrics{{"tandem_shed_level", {"instance", "level"}}, {"tandem_x_total", {}}}));
}

}  // namespace
}  // namespace tandem::test
