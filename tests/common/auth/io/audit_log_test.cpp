// The audit log: bounded, never incomplete without a note, and free of terminal control characters.
#include "common/auth/io/audit_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "common/auth/io/directory_lock.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::Folder;
using test::kNow;

StateDirectory opened(const Folder& folder) {
  auto state = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  EXPECT_TRUE(state) << state.error();
  return std::move(*state);
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(AuditLog, RotatesBySizeAndCountWithoutLosingALine) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  AuditLog log;
  log.enable_rotation({.file_max = 1000, .older = 3});
  for (int i = 0; i < 200; ++i) ASSERT_EQ(log.write(state, kNow, "event", "line-" + std::to_string(1000 + i), ""), "");
  for (const char* name : {"audit.log", "audit.log.1", "audit.log.2", "audit.log.3"}) {
    EXPECT_LE(std::filesystem::file_size(folder.path(name)), 1000u) << name;
    EXPECT_GT(std::filesystem::file_size(folder.path(name)), 0u) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("audit.log.4")));
  const std::string all =
      folder.read("audit.log.3") + folder.read("audit.log.2") + folder.read("audit.log.1") + folder.read("audit.log");
  const auto first = all.find("line-");
  const int oldest = std::stoi(all.substr(first + 5, 4));
  for (int i = oldest; i < 1200; ++i) EXPECT_EQ(count(all, "line-" + std::to_string(i)), 1u) << i;
  EXPECT_EQ(count(folder.read("audit.log"), "audit_rotated"), 1u) << "a file says that there is one before it";
  log.enable_rotation({.file_max = 1000, .older = 1});
  for (int i = 0; i < 20; ++i) ASSERT_EQ(log.write(state, kNow, "event", "more", ""), "");
  EXPECT_FALSE(std::filesystem::exists(folder.path("audit.log.2"))) << "fewer are kept from now on";
  EXPECT_FALSE(std::filesystem::exists(folder.path("audit.log.3")));
}

TEST(AuditLog, MovesAnOversizedFileAsideAndContinuesATornOneOnANewLine) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  folder.write("audit.log", std::string(StateDirectory::kFileMax + 1, 'x') + "\n");
  AuditLog log;
  log.enable_rotation({});
  ASSERT_EQ(log.write(state, kNow, "first", "", ""), "");
  EXPECT_EQ(std::filesystem::file_size(folder.path("audit.log.1")), StateDirectory::kFileMax + 2);
  EXPECT_NE(folder.read("audit.log").find("8388610 bytes are in audit.log.1"), std::string::npos)
      << folder.read("audit.log");
  folder.write("audit.log", "{\"ts\":17999");
  ASSERT_EQ(log.write(state, kNow, "second", "", ""), "");
  EXPECT_EQ(folder.read("audit.log"), "{\"ts\":17999\n{\"ts\":1800000000,\"event\":\"second\",\"name\":\"\"}\n");
}

TEST(AuditLog, CountsFailedWritesAndReportsThemLater) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  AuditLog log;
  ASSERT_EQ(mkdir(folder.path("audit.log").c_str(), 0700), 0);
  for (int i = 0; i < 3; ++i) EXPECT_NE(log.write(state, kNow + i, "lost", "", ""), "");
  EXPECT_NE(log.retry(state, kNow + 5), "");
  EXPECT_EQ(log.lost(), 3u);
  EXPECT_NE(log.error().find("audit.log"), std::string::npos);
  ASSERT_EQ(rmdir(folder.path("audit.log").c_str()), 0);
  EXPECT_EQ(log.retry(state, kNow + 9), "");
  EXPECT_EQ(log.error(), "");
  EXPECT_EQ(log.lost(), 3u);
  EXPECT_TRUE(
      folder.read("audit.log")
          .starts_with(
              "{\"ts\":1800000009,\"event\":\"audit_lost\",\"name\":\"\",\"lines\":3,\"detail\":\"since 1800000000: "))
      << folder.read("audit.log");
  EXPECT_EQ(log.write(state, kNow + 10, "again", "", ""), "");
  EXPECT_EQ(count(folder.read("audit.log"), "audit_lost"), 1u);
}

TEST(AuditLog, LosesNoLineOfSeveralProcesses) {
  const Folder folder;
  AuditLog server, command;
  server.enable_rotation({.file_max = 2000, .older = 20});
  const StateDirectory a = opened(folder), b = opened(folder);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(server.write(a, kNow, "server", "", ""), "");
    ASSERT_EQ(command.write(b, kNow, "command", "", ""), "");
  }
  std::size_t servers = 0, commands = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string text = folder.read(entry.path().filename().string());
    servers += count(text, "\"server\"");
    commands += count(text, "\"command\"");
  }
  EXPECT_EQ(servers, 100u);
  EXPECT_EQ(commands, 100u);
  EXPECT_FALSE(std::filesystem::exists(folder.path("audit.log.20")));
}

TEST(AuditLog, SanitisesUntrustedText) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  AuditLog log;
  ASSERT_EQ(log.write(state, kNow, "stop", "na\"me\\",
                      "\x1b[2Jred\n{\"ts\":1}\xe2\x80\xaegnp.exe\xff " + std::string(5000, 'w')),
            "");
  const std::string text = folder.read("audit.log");
  EXPECT_EQ(count(text, "\n"), 1u);
  EXPECT_LT(text.size(), 2 * AuditLog::kTextMax);
  EXPECT_NE(text.find("\"name\":\"na\\\"me\\\\\""), std::string::npos) << text;
  for (const char* shown : {"\\\\x1b[2Jred\\\\x0a{\\\"ts\\\":1}", "\\\\u202egnp.exe", "\\\\xff"})
    EXPECT_NE(text.find(shown), std::string::npos) << shown << "\n" << text;
  for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
}

// A console's order to stop must not wait for the disk behind a line of the log. The lock stands for a disk that is
// stuck: a writer waits for it for DirectoryLock::kTimeout, then gives its line up.
TEST(AuditLog, WritesBehindWithoutWaiting) {
  const Folder folder;
  const auto state = std::make_shared<const StateDirectory>(opened(folder));
  std::optional<AuditLog> log(std::in_place);
  log->write_behind(state);
  EXPECT_EQ(log->write(*state, kNow, "first", "", ""), "");
  while (folder.read("audit.log").empty()) std::this_thread::yield();
  {
    const auto stuck = DirectoryLock::wait(*state, AuditLog::kFile);
    ASSERT_TRUE(stuck);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(log->write(*state, kNow, "line-" + std::to_string(i), "", ""), "");
    EXPECT_EQ(count(folder.read("audit.log"), "\n"), 1u) << "the disk has none of them";
  }
  log.reset();  // the end of a server writes what waits
  const std::string all = folder.read("audit.log");
  EXPECT_EQ(count(all, "\n"), 101u);
  for (int i = 1; i < 100; ++i)
    EXPECT_LT(all.find("line-" + std::to_string(i - 1) + "\""), all.find("line-" + std::to_string(i) + "\""))
        << "in order";
}

TEST(AuditLog, CountsLinesBeyondThoseThatMayWait) {
  const Folder folder;
  const auto state = std::make_shared<const StateDirectory>(opened(folder));
  std::optional<AuditLog> log(std::in_place);
  log->write_behind(state);
  constexpr std::size_t kAll = AuditLog::kQueuedMax + 1000;
  {
    const auto stuck = DirectoryLock::wait(*state, AuditLog::kFile);
    ASSERT_TRUE(stuck);
    for (std::size_t i = 0; i < kAll; ++i) EXPECT_EQ(log->write(*state, kNow, "event", "", ""), "");
    EXPECT_GE(log->lost(), 500u) << "some lines are on their way to the disk";
    EXPECT_LE(log->lost(), 1000u);
  }
  const std::uint64_t lost = log->lost();
  log.reset();
  const std::string all = folder.read("audit.log");
  EXPECT_EQ(count(all, "\"event\":\"event\"") + lost, kAll);
  EXPECT_NE(all.find("\"audit_lost\""), std::string::npos);
}

}  // namespace
}  // namespace tandem::auth
