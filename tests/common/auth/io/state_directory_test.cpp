#include "common/auth/io/state_directory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "common/auth/io/append_file.h"
#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"
#include "common/base/raw_bytes.h"
#include "proto/text/registry_text.h"
#include "tests/common/auth/io/temporary_folder.h"
#include "tests/common/auth/support.h"

namespace tandem::auth {
namespace {

using test::Folder;
using test::kNow;

unsigned mode_of(const std::string& path) {
  struct stat s{};
  EXPECT_EQ(stat(path.c_str(), &s), 0) << path;
  return s.st_mode & 07777;
}

StateDirectory opened(const Folder& folder) {
  auto state = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  EXPECT_TRUE(state) << state.error();
  return std::move(*state);
}

/// As on a full disk: files can be made, and not filled. The limit of a file's size stands for it.
TEST(StateDirectory, ReportsThatItsFilesCannotBeFilledAndLeavesNothing) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  EXPECT_EQ(state.write_problem(), "");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1024, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string problem = state.write_problem();
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(problem.find(folder.path() + " cannot be written to: "), 0U) << problem;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(StateDirectory, KeepsFilesPrivateAndReplacesThemAtomically) {
  const Folder folder;
  const auto state = StateDirectory::open(folder.path("a/b"), StateDirectory::Missing::kIsMade);
  ASSERT_TRUE(state) << state.error();
  EXPECT_EQ(mode_of(folder.path("a/b")), 0700u);
  const mode_t before = umask(0);
  EXPECT_EQ(state->replace("x", std::string_view("one")), "");
  EXPECT_EQ(AppendFile(*state, "log").append("first\n"), "");
  umask(before);
  EXPECT_EQ(mode_of(folder.path("a/b/x")), 0600u);
  EXPECT_EQ(mode_of(folder.path("a/b/log")), 0600u);
  const auto stamp = state->stamp("x");
  EXPECT_EQ(state->replace("x", std::string_view("two")), "");
  EXPECT_NE(state->stamp("x"), stamp);
  EXPECT_EQ(AppendFile(*state, "log").append("second\n"), "");
  EXPECT_EQ(folder.read("a/b/x"), "two");
  EXPECT_EQ(folder.read("a/b/log"), "first\nsecond\n");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("a/b")))
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
  const auto read = state->read("x");
  ASSERT_TRUE(read && *read);
  EXPECT_EQ(text_of(std::as_const(**read).bytes()), "two");
  const auto none = state->read("y");
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
}

TEST(StateDirectory, RejectsFilesReadableByOthersAndNamesTheRemedy) {
  const Folder folder;
  folder.write("x", "secret", 0640);
  const auto read = opened(folder).read("x");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().find("chmod 0600"), std::string::npos) << read.error();
  EXPECT_NE(read.error().find("0640"), std::string::npos) << read.error();
  EXPECT_NE(AppendFile(opened(folder), "x").append("more"), "");
  ASSERT_EQ(chmod(folder.path().c_str(), 0750), 0);
  const auto state = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  ASSERT_FALSE(state);
  EXPECT_NE(state.error().find("chmod 0700"), std::string::npos) << state.error();
  ASSERT_EQ(chmod(folder.path().c_str(), 0700), 0);
}

TEST(StateDirectory, RefusesLinksFoldersAndPipesInPlaceOfFiles) {
  const Folder folder;
  folder.write("real", "x");
  ASSERT_EQ(symlink("real", folder.path("link").c_str()), 0);
  ASSERT_EQ(mkdir(folder.path("folder").c_str(), 0700), 0);
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  const StateDirectory state = opened(folder);
  for (const char* name : {"link", "folder", "pipe"}) EXPECT_FALSE(state.read(name)) << name;
  EXPECT_NE(AppendFile(state, "link").append("x"), "");
  EXPECT_EQ(state.replace("link", std::string_view("new")), "") << "replaced is the link, not what it names";
  EXPECT_EQ(folder.read("real"), "x");
}

TEST(StateDirectory, RefusesAnotherOwner) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to give a file to another owner";
  const Folder folder;
  folder.write("x", "secret");
  ASSERT_EQ(chown(folder.path("x").c_str(), 12345, 12345), 0);
  const auto read = opened(folder).read("x");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().find("12345"), std::string::npos) << read.error();
  ASSERT_EQ(chown(folder.path().c_str(), 12345, 12345), 0);
  const auto state = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  ASSERT_FALSE(state);
  EXPECT_NE(state.error().find("sudo -u"), std::string::npos) << state.error();
  const Folder links;
  ASSERT_EQ(symlink(links.path().c_str(), links.path("own").c_str()), 0);
  EXPECT_TRUE(StateDirectory::open(links.path("own"), StateDirectory::Missing::kIsAnError)) << "root's own link";
  ASSERT_EQ(lchown(links.path("own").c_str(), 12345, 12345), 0);
  EXPECT_FALSE(StateDirectory::open(links.path("own"), StateDirectory::Missing::kIsAnError)) << "a stranger's";
}

TEST(StatePath, UsesTheUsersRuntimeFolderWhereThereIsOne) {
  const Folder run;
  const std::string own = run.path(std::to_string(geteuid())),
                    before = getenv("XDG_RUNTIME_DIR") == nullptr ? "" : getenv("XDG_RUNTIME_DIR");
  unsetenv("TANDEM_RUNTIME");
  setenv("XDG_RUNTIME_DIR", "/run/session", 1);
  ASSERT_EQ(mkdir(own.c_str(), 0700), 0);
  EXPECT_EQ(runtime_path(run.path()), "/run/session/tandem");
  unsetenv("XDG_RUNTIME_DIR");
  EXPECT_EQ(runtime_path(run.path()), own + "/tandem");
  const std::string shared = "/tmp/tandem-" + std::to_string(geteuid());
  EXPECT_EQ(runtime_path(run.path("nothing")), shared);
  ASSERT_EQ(rmdir(own.c_str()), 0);
  ASSERT_EQ(symlink(run.path().c_str(), own.c_str()), 0);
  EXPECT_EQ(runtime_path(run.path()), shared) << "a link is not the user's folder";
  if (geteuid() == 0) {
    ASSERT_EQ(unlink(own.c_str()), 0);
    ASSERT_EQ(mkdir(own.c_str(), 0700), 0);
    ASSERT_EQ(chown(own.c_str(), 12345, 12345), 0);
    EXPECT_EQ(runtime_path(run.path()), shared) << "of another user";
  }
  if (!before.empty()) setenv("XDG_RUNTIME_DIR", before.c_str(), 1);
}

TEST(StatePath, IsTheOptionThenTheEnvironmentThenTheHome) {
  EXPECT_EQ(client_state_path("/x"), "/x");
  setenv("TANDEM_CLIENT_STATE", "/y", 1);
  EXPECT_EQ(client_state_path(""), "/y");
  unsetenv("TANDEM_CLIENT_STATE");
  const std::string home = getenv("HOME") == nullptr ? "" : getenv("HOME");
  setenv("HOME", "/home/user", 1);
  EXPECT_EQ(client_state_path(""), "/home/user/.config/tandem");
  setenv("TANDEM_STATE", "/z", 1);
  EXPECT_EQ(server_state_path(""), "/z");
  EXPECT_EQ(server_state_path("/a"), "/a");
  unsetenv("TANDEM_STATE");
  unsetenv("HOME");
  EXPECT_FALSE(client_state_path(""));
  if (!home.empty()) setenv("HOME", home.c_str(), 1);
  setenv("TANDEM_RUNTIME", "/run/x", 1);
  EXPECT_EQ(runtime_path(), "/run/x");
  unsetenv("TANDEM_RUNTIME");
}

TEST(ServerKeystore, InitialisesOnceAndReopens) {
  const Folder folder;
  EXPECT_FALSE(ServerKeystore::open(folder.path("s"))) << "not initialised";
  EXPECT_NE(ServerKeystore::open(folder.path("s")).error().find("tandem-server init"), std::string::npos);
  const auto fingerprint = ServerKeystore::init(folder.path("s"), kNow);
  ASSERT_TRUE(fingerprint) << fingerprint.error();
  EXPECT_FALSE(ServerKeystore::init(folder.path("s"), kNow));
  const auto trust = ServerKeystore::open(folder.path("s"));
  ASSERT_TRUE(trust) << trust.error();
  EXPECT_EQ(trust->identity().fingerprint(), *fingerprint);
  for (const char* name : {ServerKeystore::kKeyFile, ServerKeystore::kCertificateFile, ServerKeystore::kTicketKeyFile,
                           ServerRegistry::kWorkstationsFile, ServerRegistry::kCodesFile})
    EXPECT_EQ(mode_of(folder.path(std::string("s/") + name)), 0600u) << name;
}

/// New keys shut out the workstations, and `init` refuses such a folder.
TEST(ServerKeystore, AsksForTheBackupOfAKeyThatAUsedFolderHasLost) {
  for (const char* lost :
       {ServerKeystore::kKeyFile, ServerKeystore::kCertificateFile, ServerKeystore::kTicketKeyFile}) {
    const Folder folder;
    ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
    ASSERT_EQ(ServerKeystore::open(folder.path())->audit(kNow, "init", ""), "");
    std::filesystem::remove(folder.path(lost));
    const std::string why = ServerKeystore::open(folder.path()).error();
    EXPECT_NE(why.find(std::string(lost) + " is missing"), std::string::npos) << why;
    EXPECT_NE(why.find("restore the file from a backup. New keys would shut out every enrolled workstation"),
              std::string::npos)
        << why;
    EXPECT_EQ(why.find("init` first"), std::string::npos) << why;
  }
  const Folder unused;
  ASSERT_TRUE(ServerKeystore::init(unused.path(), kNow));
  std::filesystem::remove(unused.path(ServerKeystore::kKeyFile));
  EXPECT_NE(ServerKeystore::open(unused.path()).error().find("run `tandem-server init"), std::string::npos);
}

TEST(ServerKeystore, KeepsCodesAsHashesOnly) {
  const Folder folder;
  ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
  auto trust = ServerKeystore::open(folder.path());
  ASSERT_TRUE(trust);
  const auto code = test::secret_from<16>(77);
  ASSERT_EQ(trust->registry().issue_code(code, "touch-07", kNow, kNow + 10), "");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string text = folder.read(entry.path().filename().string());
    EXPECT_EQ(text.find(to_hex(code.bytes)), std::string::npos) << entry.path();
    EXPECT_EQ(text.find(std::string(as_text(code.bytes.data()), 16)), std::string::npos) << entry.path();
  }
  EXPECT_NE(folder.read("codes.textproto").find(to_hex(hash_of(code))), std::string::npos);
}

TEST(ServerKeystore, SeesChangesByAnotherProcessAtTheNextLookUp) {
  const Folder folder;
  ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
  auto running = ServerKeystore::open(folder.path()), command = ServerKeystore::open(folder.path());
  ASSERT_TRUE(running && command);
  const KeyFingerprint fingerprint{test::counting<32>(5)};
  EXPECT_FALSE(*running->registry().find(fingerprint));
  for (int i = 0; i < 50; ++i) {  // also within one tick of the file system's clock
    ASSERT_EQ(command->registry().enroll_without_code({"w", fingerprint.sha256, kNow}), "");
    ASSERT_TRUE(*running->registry().find(fingerprint)) << i;
    ASSERT_TRUE(command->registry().revoke("w"));
    ASSERT_FALSE(*running->registry().find(fingerprint)) << i;
  }
}

TEST(ServerKeystore, RejectsAllClientsIfAFileIsUnreadable) {
  const Folder folder;
  ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
  auto trust = ServerKeystore::open(folder.path());
  ASSERT_TRUE(trust);
  const KeyFingerprint fingerprint{test::counting<32>(5)};
  ASSERT_EQ(trust->registry().enroll_without_code({"w", fingerprint.sha256, kNow}), "");
  ASSERT_TRUE(*trust->registry().find(fingerprint));
  folder.write("workstations.textproto", "workstation { nam: \"w\" }");
  const auto row = trust->registry().find(fingerprint);
  ASSERT_FALSE(row);
  EXPECT_NE(row.error().find("workstations.textproto:1:"), std::string::npos) << row.error();
  EXPECT_FALSE(trust->registry().find(fingerprint)) << "not the last good one either";
}

TEST(ServerKeystore, RedeemsATicketOnceAcrossRestarts) {
  const Folder folder;
  ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
  const Ticket ticket = test::sample_ticket();
  TicketBytes bytes;
  {
    auto trust = ServerKeystore::open(folder.path());
    ASSERT_TRUE(trust);
    bytes = *sign_ticket(ticket, trust->ticket_key());
    EXPECT_FALSE(trust->tickets().redeem(bytes, test::sample_use(ticket))) << "not serving yet";
    ASSERT_EQ(trust->begin_serving(kNow), "");
    ASSERT_TRUE(trust->tickets().redeem(bytes, test::sample_use(ticket)));
    EXPECT_EQ(trust->tickets().redeem(bytes, test::sample_use(ticket)).error().fault->rule, TicketCheck::kUsed);
  }
  auto trust = ServerKeystore::open(folder.path());
  ASSERT_TRUE(trust);
  ASSERT_EQ(trust->begin_serving(kNow), "");
  EXPECT_EQ(trust->tickets().redeem(bytes, test::sample_use(ticket)).error().fault->rule, TicketCheck::kUsed);
}

/// If the registry cannot be written, the server rejects before it uses anything up. A failed write damages neither the
/// stored registry nor the next write.
TEST(ServerKeystore, KeepsATicketValidIfItsUseCannotBeWritten) {
  const Folder folder;
  ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
  auto trust = ServerKeystore::open(folder.path());
  ASSERT_TRUE(trust);
  ASSERT_EQ(trust->begin_serving(kNow), "");
  const Ticket ticket = test::sample_ticket();
  const TicketBytes bytes = *sign_ticket(ticket, trust->ticket_key());
  std::filesystem::rename(folder.path("used_tickets"), folder.path("aside"));
  ASSERT_EQ(mkdir(folder.path("used_tickets").c_str(), 0700), 0);
  for (int i = 0; i < 2; ++i) {
    const auto refused = trust->tickets().redeem(bytes, test::sample_use(ticket));
    ASSERT_FALSE(refused);
    EXPECT_FALSE(refused.error().fault) << "the server's trouble, not the ticket's: " << refused.error().text;
  }
  ASSERT_EQ(rmdir(folder.path("used_tickets").c_str()), 0);
  EXPECT_TRUE(trust->tickets().redeem(bytes, test::sample_use(ticket)));
  EXPECT_EQ(trust->tickets().redeem(bytes, test::sample_use(ticket)).error().fault->rule, TicketCheck::kUsed);
}

TEST(ServerKeystore, AllowsOneServerPerFolderAndReportsWhetherOneRuns) {
  const Folder folder;
  ASSERT_TRUE(ServerKeystore::init(folder.path(), kNow));
  auto command = ServerKeystore::open(folder.path());
  ASSERT_TRUE(command);
  const ServingSpec serving{"127.0.0.1:7000", {}};
  {
    auto first = ServerKeystore::open(folder.path()), second = ServerKeystore::open(folder.path());
    ASSERT_EQ(first->begin_serving(kNow), "");
    EXPECT_NE(second->begin_serving(kNow).find("another server runs"), std::string::npos);
    ASSERT_EQ(first->serving().write(serving), "");
    EXPECT_EQ(*command->serving().read(), serving);
  }
  EXPECT_EQ(*command->serving().read(), std::nullopt);
  folder.write("serving.textproto", print_serving(serving));  // as a killed server leaves it
  EXPECT_EQ(*command->serving().read(), std::nullopt);
}

TEST(ClientKeystore, CreatesItsKeyOnceAndStoresServers) {
  const Folder folder;
  EXPECT_EQ(ClientKeystore::open(folder.path("c"))->has_value(), false);
  KeyFingerprint fingerprint;
  {
    const auto made = ClientKeystore::open_or_make(folder.path("c"), kNow);
    ASSERT_TRUE(made) << made.error();
    fingerprint = made->identity().fingerprint();
    EXPECT_EQ(made->store_server({"h:1", test::counting<32>(1), "touch-07"}), "");
  }
  const auto again = ClientKeystore::open(folder.path("c"));
  ASSERT_TRUE(again && *again);
  EXPECT_EQ((*again)->identity().fingerprint(), fingerprint);
  EXPECT_EQ((*again)->servers()->at(0).name, "touch-07");
  EXPECT_EQ(ClientKeystore::open_or_make(folder.path("c"), kNow)->identity().fingerprint(), fingerprint);
  EXPECT_EQ(mode_of(folder.path("c/workstation_key.pem")), 0600u);
}

TEST(RuntimeDirectory, IsFoundByTheServersFingerprintAndRemovedWithTheServer) {
  const Folder folder;
  const KeyFingerprint server{test::counting<32>(1)};
  const auto serial = test::counting<16>();
  const LocalKeys keys{Identity::make("local", serial, kNow), test::ticket_key(3)};
  {
    const auto published = RuntimeDirectory::publish(folder.path("run"), server, keys);
    ASSERT_TRUE(published) << published.error();
    EXPECT_EQ(mode_of(folder.path("run/" + server.hex() + ".local")), 0600u);
    const auto found = find_local_keys(folder.path("run"), server);
    ASSERT_TRUE(found && *found) << (found ? "" : found.error());
    EXPECT_EQ((*found)->workstation.fingerprint(), keys.workstation.fingerprint());
    EXPECT_EQ((*found)->ticket_key.verifier().key, keys.ticket_key.verifier().key);
    EXPECT_FALSE(*find_local_keys(folder.path("run"), KeyFingerprint{}));
    ASSERT_EQ(chmod(folder.path("run/" + server.hex() + ".local").c_str(), 0644), 0);
    EXPECT_FALSE(find_local_keys(folder.path("run"), server)) << "others could have read it";
  }
  EXPECT_FALSE(*find_local_keys(folder.path("run"), server));
  EXPECT_FALSE(*find_local_keys(folder.path("nowhere"), server));
}

}  // namespace
}  // namespace tandem::auth
