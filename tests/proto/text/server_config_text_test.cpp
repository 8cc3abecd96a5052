// Server configurations: accepted and rejected input, with the position of every error.
#include "proto/text/server_config_text.h"

#include <gtest/gtest.h>

#include "proto/rpc/rpc_limits.h"

namespace tandem {
namespace {

constexpr const char* kSmall = "version: 1\nlisten: \"127.0.0.1:7000\"\nsession { name: \"a\" scene: \"contact\" }\n";

std::string mistakes_of(const std::string& text) {
  const auto config = parse_server_config(text, "s.textproto");
  return config ? "" : to_text(config.error());
}

TEST(ServerConfig, UsesTheDefaultLimitsForThreeLines) {
  const auto config = parse_server_config(kSmall, "s.textproto");
  ASSERT_TRUE(config) << to_text(config.error());
  EXPECT_EQ(config->listen.text, "127.0.0.1:7000");
  ASSERT_EQ(config->sessions.size(), 1u);
  EXPECT_EQ(config->sessions[0].scene.text, "contact");
  EXPECT_EQ(config->sessions[0].scene.line, 3);
  EXPECT_TRUE(config->sessions[0].restart);
  EXPECT_FALSE(config->sessions[0].tickets_only);
  EXPECT_EQ(config->limits.core_percent, 85);
  EXPECT_EQ(config->limits.pending, 256u);
  EXPECT_FALSE(config->log.json);
}

TEST(ServerConfig, ReportsAllMistakesWithTheirPlaces) {
  const std::string told = mistakes_of(
      "version: 1\nlisen: \"127.0.0.1:7000\"\nsession { name: \"a b\" scene: \"contact\" }\nsession { name: \"c\" "
      "scene: \"\" }\n"
      "session { name: \"c\" scene: \"contact\" entry: CODES }\nlimits { load_percent: 61 pending: 257 deadline_s: nan "
      "}\n");
  for (const char* mistake :
       {"s.textproto:2:1: lisen", "listen", "s.textproto:3:17: session[0].name", "s.textproto:4:28: session[1].scene",
        "s.textproto:5:17: session[2].name = \"c\"", "session[2].entry = CODES",
        "s.textproto:6:24: limits.load_percent = 61", "limits.pending = 257", "limits.deadline_s = nan"})
    EXPECT_NE(told.find(mistake), std::string::npos) << mistake << " is not in\n" << told;
}

TEST(ServerConfig, RejectsLimitsLooserThanTheDefaults) {
  for (const char* limit :
       {"accepts_per_s: 10.1", "accepts_burst: 101", "accepts_per_s_all: 301", "connections: 2049", "deadline_s: 5.1",
        "load_percent: 60.1", "core_percent: 85.1", "created_sessions: 257", "threads: 65"})
    EXPECT_NE(mistakes_of(std::string(kSmall) + "limits { " + limit + " }"), "") << limit;
  for (const char* limit : {"accepts_per_s: 10", "accepts_burst: 100", "accepts_per_s_all: 300", "connections: 2048",
                            "deadline_s: 5", "load_percent: 60", "core_percent: 85", "created_sessions: 256",
                            "created_sessions: 0", "threads: 64", "threads: 0"})
    EXPECT_EQ(mistakes_of(std::string(kSmall) + "limits { " + limit + " }"), "") << limit;
}

TEST(ServerConfig, TakesTheSmallerOfBothLimitsOfAnOlderConfiguration) {
  const auto core_percent = [](const std::string& limits) {
    const auto config = parse_server_config(std::string(kSmall) + "limits { " + limits + " }", "s.textproto");
    return config ? config->limits.core_percent : -1;
  };
  EXPECT_EQ(core_percent("load_percent: 40"), 40);
  EXPECT_EQ(core_percent("load_percent: 40 core_percent: 80"), 40);
  EXPECT_EQ(core_percent("load_percent: 60 core_percent: 50"), 50);
  EXPECT_EQ(core_percent("core_percent: 70"), 70);
}

TEST(ServerConfig, NamesAtMost256Sessions) {
  std::string text = "version: 1 listen: \"127.0.0.1:0\"\n";
  for (std::size_t i = 0; i < rpc::kSessionsMax; ++i)
    text += "session { name: \"s" + std::to_string(i) + "\" scene: \"contact\" }\n";
  const auto full = parse_server_config(text, "s.textproto");
  ASSERT_TRUE(full) << to_text(full.error());
  EXPECT_EQ(full->sessions.size(), 256U);
  const std::string told = mistakes_of(text + "session { name: \"beyond\" scene: \"contact\" }\n");
  EXPECT_NE(told.find("at most 256 are allowed, here are 257"), std::string::npos) << told;
}

TEST(ServerConfig, ReadsSizeAndCountOfTheAuditLog) {
  const auto config = parse_server_config(kSmall, "s.textproto");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->audit.file_mib, 8);
  EXPECT_EQ(config->audit.older_files, 7u);
  for (const char* wrong : {"file_mib: 0.06", "file_mib: 1025", "older_files: 0", "older_files: 100"})
    EXPECT_NE(mistakes_of(std::string(kSmall) + "audit { " + wrong + " }"), "") << wrong;
  const auto small = parse_server_config(
      std::string(kSmall) + "audit { file_mib: 0.0625 older_files: 1 } metrics_host: \"monitor.lab\"", "s.textproto");
  ASSERT_TRUE(small) << to_text(small.error());
  EXPECT_EQ(small->audit.file_mib, 0.0625);
  EXPECT_EQ(small->metrics_hosts, std::vector<std::string>{"monitor.lab"});
  EXPECT_NE(effective_server_config_text(*small).find("audit.older_files"), std::string::npos);
  for (const char* name : {"", "a:9464", "http://a"})
    EXPECT_NE(mistakes_of(std::string(kSmall) + "metrics_host: \"" + name + "\"").find("metrics_host[0]"),
              std::string::npos)
        << name;
}

TEST(ServerConfig, ReadsWhereAndHowSessionsAreRecorded) {
  const auto none = parse_server_config(kSmall, "s.textproto");
  ASSERT_TRUE(none);
  EXPECT_EQ(none->record.text, "");
  EXPECT_EQ(none->sessions[0].record.text, "");
  EXPECT_FALSE(none->recording.pseudonyms);
  EXPECT_TRUE(none->recording.from_start);
  EXPECT_EQ(none->recording.inputs_mib, 1024);
  const auto all = parse_server_config(
      "version: 1 listen: \"127.0.0.1:7000\" session { name: \"a\" scene: \"contact\" record: \"a.mcap\" }\n"
      "record: \"films\" recording { pseudonyms: true from_start: false file_mib: 1 file_minutes: 0.1 total_mib: 2 "
      "mib_per_min: 0.5 inputs_mib: 0 }",
      "s.textproto");
  ASSERT_TRUE(all) << to_text(all.error());
  EXPECT_EQ(all->record.text, "films");
  EXPECT_EQ(all->record.line, 2);
  EXPECT_EQ(all->sessions[0].record.text, "a.mcap");
  EXPECT_TRUE(all->recording.pseudonyms);
  EXPECT_FALSE(all->recording.from_start);
  EXPECT_EQ(all->recording.total_mib, 2);
  EXPECT_EQ(all->recording.inputs_mib, 0);
  const std::string listing = effective_server_config_text(*all);
  for (const char* shown : {"record", "a.mcap", "recording.pseudonyms", "recording.mib_per_min", "MiB/min"})
    EXPECT_NE(listing.find(shown), std::string::npos) << shown << " is not in\n" << listing;
  for (const char* wrong : {"file_mib: 0.9", "file_mib: 4097", "file_minutes: 0.09", "file_minutes: 1441",
                            "total_mib: 0", "mib_per_min: 0.09", "mib_per_min: 1001", "mib_per_min: nan",
                            "inputs_mib: -1", "inputs_mib: 65537", "names: 1"})
    EXPECT_NE(mistakes_of(std::string(kSmall) + "recording { " + wrong + " }"), "") << wrong;
  EXPECT_NE(mistakes_of(std::string(kSmall) + "record: \"\"").find("record"), std::string::npos);
}

TEST(ServerConfig, ReadsTheDirectoryOfAService) {
  const auto alone = parse_server_config(kSmall, "s.textproto");
  ASSERT_TRUE(alone);
  EXPECT_FALSE(alone->directory);
  const auto small = parse_server_config(std::string(kSmall) + "directory { endpoint: \"[::1]:2379\" }", "s.textproto");
  ASSERT_TRUE(small) << to_text(small.error());
  EXPECT_EQ(small->directory->prefix, "/tandem/v1/");
  EXPECT_EQ(small->directory->ttl_s, 3u);
  EXPECT_TRUE(small->directory->balance);
  EXPECT_EQ(small->directory->server.text, "");
  const auto all = parse_server_config(
      std::string(kSmall) +
          "directory { endpoint: \"a:2379\" endpoint: \"b:65535\" prefix: \"/school/\" authority: \"ca.pem\"\n"
          "certificate: \"c.pem\" private_key: \"k.pem\" name_in_certificate: \"etcd\" server: \"desk-a_lab\"\n"
          "address: \"10.0.0.7:7000\" zone: \"north\" ttl_s: 60 balance: false }",
      "s.textproto");
  ASSERT_TRUE(all) << to_text(all.error());
  const DirectorySpec& got = *all->directory;
  ASSERT_EQ(got.endpoints.size(), 2u);
  EXPECT_EQ(got.endpoints[1].text, "b:65535");
  EXPECT_EQ(got.prefix, "/school/");
  EXPECT_EQ(got.private_key.text, "k.pem");
  EXPECT_EQ(got.name_in_certificate, "etcd");
  EXPECT_EQ(got.server.text, "desk-a_lab");
  EXPECT_EQ(got.address.text, "10.0.0.7:7000");
  EXPECT_EQ(got.address.line, 6);
  EXPECT_EQ(got.zone, "north");
  EXPECT_EQ(got.ttl_s, 60u);
  EXPECT_FALSE(got.balance);
  const std::string listing = effective_server_config_text(*all);
  for (const char* shown : {"directory.endpoint[1]", "b:65535", "directory.zone", "directory.ttl_s", "/school/"})
    EXPECT_NE(listing.find(shown), std::string::npos) << shown << " is not in\n" << listing;
}

TEST(ServerConfig, ReportsMistakesInTheDirectoryOfAService) {
  EXPECT_NE(mistakes_of(std::string(kSmall) + "directory { }").find("at least one member of etcd"), std::string::npos);
  for (const char* wrong : {"endpoint: \"b\"",
                            "endpoint: \":2379\"",
                            "endpoint: \"b:0\"",
                            "endpoint: \"b:65536\"",
                            "endpoint: \"http://b:2379\"",
                            "endpoint: \"b:2379x\"",
                            "prefix: \"x/\"",
                            "prefix: \"/x\"",
                            "prefix: \"\"",
                            "prefix: \"/a b/\"",
                            "authority: \"ca.pem\"",
                            "authority: \"\"",
                            "name_in_certificate: \"etcd\"",
                            "server: \"\"",
                            "server: \"a b\"",
                            "server: \"a.b\"",
                            "address: \"\"",
                            "zone: \"a b\"",
                            "ttl_s: 1",
                            "ttl_s: 61",
                            "lease: 3"}) {
    const std::string told = mistakes_of(std::string(kSmall) + "directory { endpoint: \"a:1\" " + wrong + " }");
    EXPECT_NE(told.find("s.textproto:4:"), std::string::npos) << wrong << " gives\n" << told;
    EXPECT_NE(told.find("directory"), std::string::npos) << wrong << " gives\n" << told;
  }
}

TEST(ServerConfig, RequiresASession) {
  EXPECT_NE(mistakes_of("version: 1 listen: \"127.0.0.1:7000\"").find("session"), std::string::npos);
  EXPECT_NE(mistakes_of(""), "");
}

TEST(ServerConfig, ListsItsEffectiveValues) {
  const auto config = parse_server_config(
      std::string(kSmall) + "limits { core_percent: 40 } log { format: JSON } reports: \"r\"", "s.textproto");
  ASSERT_TRUE(config);
  const std::string listing = effective_server_config_text(*config);
  for (const char* key :
       {"session[0].name", "limits.core_percent", "40", "JSON", "limits.accepts_per_s", "reports", "restart"})
    EXPECT_NE(listing.find(key), std::string::npos) << key << "\n" << listing;
}

}  // namespace
}  // namespace tandem
