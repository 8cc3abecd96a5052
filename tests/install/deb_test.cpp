// Tests of the Debian packages: builds them, checks their contents, unpacks each into a separate root and runs its
// program there. With TANDEM_COUNTS=full and debootstrap, installs them into a fresh Debian 12.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/install/shell.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

const fs::path kPlace = fs::path{TANDEM_BINARY_DIR} / "debs";

/// Builds all packages once. @return reason why they cannot be built; empty on success
const std::string& packages() {
  static const std::string problem = []() -> std::string {
    if (std::string_view{TANDEM_SANITIZE} != "") return "a build with sanitizers is not for installing";
    for (const char* tool : {"dpkg-deb", "dpkg-shlibdeps"})
      if (!there(tool)) return std::string(tool) + " is not installed (apt install dpkg-dev)";
    fs::remove_all(kPlace);
    const Done made = shell(quoted(TANDEM_CMAKE) + " --build " + quoted(TANDEM_BINARY_DIR) + " --target manuals && " +
                            quoted(TANDEM_CPACK) + " --config " +
                            quoted(fs::path{TANDEM_BINARY_DIR} / "CPackConfig.cmake") + " -B " + quoted(kPlace));
    EXPECT_EQ(made.code, 0) << made.text;
    return "";
  }();
  return problem;
}

fs::path package(const std::string& name) {
  for (const auto& entry : fs::directory_iterator(kPlace))
    if (entry.path().extension() == ".deb" && entry.path().filename().string().starts_with(name + "_"))
      return entry.path();
  ADD_FAILURE() << "no package " << name;
  return {};
}

/// Checks the package of C++ libraries for other projects.
void check_development_package() {
  const fs::path deb = package("tandem-dev"), root = kPlace / "root-tandem-dev";
  ASSERT_EQ(shell("dpkg-deb -x " + quoted(deb) + " " + quoted(root)).code, 0);
  for (const char* file : {"usr/include/tandem/client.h", "usr/include/tandem/control.h", "usr/lib/libtandem_netsim.a",
                           "usr/lib/cmake/Tandem/TandemConfig.cmake", "usr/share/doc/tandem-dev/copyright"})
    EXPECT_TRUE(fs::exists(root / file)) << file << "\n" << shell("dpkg-deb -c " + quoted(deb)).text;
  EXPECT_FALSE(fs::exists(root / "usr/bin")) << "the programs have packages of their own";
  const std::string depends = shell("dpkg-deb -f " + quoted(deb) + " Depends").text;
  for (const char* needed : {"libeigen3-dev", "libprotobuf-dev", "libspdlog-dev", "libssl-dev", "libsodium-dev"})
    EXPECT_NE(depends.find(needed), std::string::npos) << needed << " is not in " << depends;
}

/// Checks that every relative link of the installed documents leads to an installed file.
void check_links(const fs::path& documents) {
  const std::regex link{R"(\]\(([^)#\s]+))"};
  std::size_t links = 0;
  for (const auto& entry : fs::recursive_directory_iterator(documents)) {
    if (entry.path().extension() != ".md") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (auto found = std::sregex_iterator(text.begin(), text.end(), link); found != std::sregex_iterator(); ++found) {
      const std::string target = (*found)[1];
      if (target.find(':') != std::string::npos) continue;  // https:
      EXPECT_TRUE(fs::exists(entry.path().parent_path() / target)) << entry.path() << " links " << target;
      ++links;
    }
  }
  EXPECT_GT(links, 20u) << "the manuals are not there";
}

TEST(DebianPackages, ContainTheirFilesAndRunFromAnUnpackedRoot) {
  if (const std::string& why = packages(); !why.empty()) GTEST_SKIP() << why;
  for (const std::string name : {"tandem-server", "tandem-client", "tandem-netsim", "tandem-console"}) {
    SCOPED_TRACE(name);
    const fs::path deb = package(name), root = kPlace / ("root-" + name);
    const std::string contents = shell("dpkg-deb -c " + quoted(deb)).text;
    for (const std::string& file :
         {"./usr/bin/" + name, "./usr/share/man/man1/" + name + ".1", "./usr/share/doc/" + name + "/copyright",
          "./usr/share/doc/" + name + "/" + name + ".spdx.json"})
      EXPECT_NE(contents.find(file), std::string::npos) << file << "\n" << contents;
    const std::string info = shell("dpkg-deb -f " + quoted(deb)).text;
    for (const char* field : {"Architecture: ", "libc6", "libprotobuf", "Version: " TANDEM_VERSION})
      EXPECT_NE(info.find(field), std::string::npos) << field << "\n" << info;
    ASSERT_EQ(shell("dpkg-deb -x " + quoted(deb) + " " + quoted(root)).code, 0);
    const Done version = shell(quoted(root / "usr/bin" / name) + " --version");
    EXPECT_EQ(version.code, 0) << version.text;
    EXPECT_NE(version.text.find(TANDEM_VERSION), std::string::npos) << version.text;
    if (there("man")) {
      const Done page =
          shell("man --warnings -l " + quoted(root / ("usr/share/man/man1/" + name + ".1.gz")) + " >/dev/null");
      EXPECT_EQ(page.text, "") << "the manual page has mistakes";
    }
    // `apropos` and `man -f` show this line; it must be a complete sentence.
    const std::string summary =
        shell("zcat " + quoted(root / ("usr/share/man/man1/" + name + ".1.gz")) + " | sed -n '/^.SH NAME/{n;p;q}'")
            .text;
    EXPECT_TRUE(summary.starts_with(name + " \\- ") && summary.ends_with(".\n")) << summary;
  }
  const fs::path deb = package("tandem-server"), root = kPlace / "root-tandem-server", control = kPlace / "control";
  ASSERT_EQ(shell("dpkg-deb -e " + quoted(deb) + " " + quoted(control)).code, 0);
  EXPECT_EQ(shell("cat " + quoted(control / "conffiles")).text, "/etc/tandem/server.textproto\n");
  for (const char* script : {"postinst", "prerm", "postrm"})
    EXPECT_EQ(shell("sh -n " + quoted(control / script)).code, 0) << script;
  EXPECT_TRUE(fs::exists(root / "lib/systemd/system/tandem-server.service"));
  EXPECT_TRUE(fs::exists(kPlace / "root-tandem-console/lib/systemd/system/tandem-console.service"));
  check_links(root / "usr/share/doc/tandem-server");
  ASSERT_NO_FATAL_FAILURE(check_development_package());

  // The installed configuration, but with a state directory that this test may write.
  const fs::path state = kPlace / "state", config = kPlace / "server.textproto";
  const std::string server = quoted(root / "usr/bin/tandem-server");
  ASSERT_EQ(shell("sed 's|/var/lib/tandem|" + state.string() + "|' " + quoted(root / "etc/tandem/server.textproto") +
                  " > " + quoted(config))
                .code,
            0);
  const Done before = shell(server + " serve " + quoted(config) + " --check");
  EXPECT_EQ(before.code, 2) << before.text;
  EXPECT_NE(before.text.find("tandem-server init"), std::string::npos) << "says what to run first\n" << before.text;
  EXPECT_EQ(shell(server + " init --state " + quoted(state)).code, 0);
  const Done after = shell(server + " serve " + quoted(config) + " --check");
  EXPECT_EQ(after.code, 0) << after.text;
}

// lintian must find no error and no warning; none is overridden. (Tags of lower severity concern packages in Debian's
// own archive.)
TEST(DebianPackages, PassLintian) {
  const char* counts = std::getenv("TANDEM_COUNTS");
  if (counts == nullptr || std::string_view{counts} == "reduced")
    GTEST_SKIP() << "belongs to ./test --full (TANDEM_COUNTS=full), which installs lintian";
  if (!there("lintian")) GTEST_SKIP() << "lintian is not installed (./test --full installs it)";
  if (const std::string& why = packages(); !why.empty()) GTEST_SKIP() << why;
  for (const std::string name : {"tandem-server", "tandem-client", "tandem-netsim", "tandem-console", "tandem-dev"}) {
    const Done judged =
        shell("lintian --allow-root --tag-display-limit 0 --fail-on error,warning " + quoted(package(name)));
    EXPECT_EQ(judged.code, 0) << judged.text;
    std::printf("[ lintian  ] %s: %s\n", name.c_str(), judged.text.empty() ? "nothing" : judged.text.c_str());
  }
}

/// Runs maintainer scripts as on a system with systemd, with stub commands that only record their arguments.
class Scripts {
 public:
  Scripts() {
    fs::remove_all(place_);
    fs::create_directories(place_ / "bin");
    fs::create_directories(place_ / "systemd");
    for (const char* command :
         {"systemctl", "deb-systemd-invoke", "deb-systemd-helper", "adduser", "install", "getent", "rm"}) {
      std::ofstream(place_ / "bin" / command)
          << "#!/bin/sh\necho " << command << " \"$@\" >> " << quoted(place_ / "calls") << "\n";
      fs::permissions(place_ / "bin" / command, fs::perms::owner_all);
    }
  }
  /// Runs `script`. @return the recorded calls, one per line
  [[nodiscard]] std::string run(const std::string& script, const std::string& arguments,
                                const std::string& program = "tandem-server") const {
    fs::remove(place_ / "calls");
    const Done done = shell("sed 's|/run/systemd/system|" + (place_ / "systemd").string() + "|' " +
                            quoted(fs::path{TANDEM_SOURCE_DIR} / "server/package" / (program + "." + script)) +
                            " | PATH=" + quoted(place_ / "bin") + ":$PATH sh -s " + arguments);
    EXPECT_EQ(done.code, 0) << done.text;
    return shell("cat " + quoted(place_ / "calls")).text;
  }

 private:
  fs::path place_ = fs::path{TANDEM_BINARY_DIR} / "scripts";
};

TEST(MaintainerScripts, RestartTheServiceOnUpgradeAndStartNothingOnInstallation) {
  const Scripts scripts;
  const std::string upgraded = scripts.run("postinst", "configure 0.0.9");
  const auto reload = upgraded.find("systemctl --system daemon-reload\n"),
             restart = upgraded.find("deb-systemd-invoke try-restart tandem-server.service\n");
  ASSERT_NE(restart, std::string::npos) << upgraded;
  EXPECT_LT(reload, restart) << "the new unit first\n" << upgraded;
  const std::string installed = scripts.run("postinst", "configure ''");
  EXPECT_EQ(installed.find("deb-systemd-invoke"), std::string::npos) << installed;
  EXPECT_NE(installed.find("install -d -m 0700 -o tandem -g tandem /var/lib/tandem\n"), std::string::npos) << installed;
  EXPECT_EQ(scripts.run("prerm", "upgrade 0.2.0").find("stop"), std::string::npos) << "until then the old one serves";
  EXPECT_NE(scripts.run("prerm", "remove").find("deb-systemd-invoke stop tandem-server.service\n"), std::string::npos);
  EXPECT_EQ(scripts.run("postrm", "remove").find("rm "), std::string::npos) << "the keys stay";
  EXPECT_NE(scripts.run("postrm", "purge").find("rm -rf /var/lib/tandem\n"), std::string::npos);
}

TEST(MaintainerScripts, RestartTheConsoleOnUpgradeAndStartNothingOnInstallation) {
  const Scripts scripts;
  const auto run = [&scripts](const std::string& script, const std::string& arguments) {
    return scripts.run(script, arguments, "tandem-console");
  };
  EXPECT_NE(run("postinst", "configure 0.0.9").find("deb-systemd-invoke try-restart tandem-console.service\n"),
            std::string::npos);
  EXPECT_EQ(run("postinst", "configure ''").find("deb-systemd-invoke"), std::string::npos);
  EXPECT_EQ(run("prerm", "upgrade 0.2.0").find("stop"), std::string::npos) << "until then the old one serves";
  EXPECT_NE(run("prerm", "remove").find("deb-systemd-invoke stop tandem-console.service\n"), std::string::npos);
  EXPECT_EQ(run("postrm", "remove").find("rm "), std::string::npos) << "the key stays";
  EXPECT_NE(run("postrm", "purge").find("rm -rf /var/lib/tandem-console /var/lib/private/tandem-console\n"),
            std::string::npos);
}

constexpr const char* kNoSystemd = "systemd-analyze is not installed (package systemd)";

TEST(DebianPackages, ContainHardenedUnits) {
  if (!there("systemd-analyze")) GTEST_SKIP() << kNoSystemd;
  for (const char* unit : {"tandem-server.service", "tandem-console.service"}) {
    const Done judged = shell("systemd-analyze security --offline=true --threshold=30 " +
                              quoted(fs::path{TANDEM_SOURCE_DIR} / "server/package" / unit));
    const auto at = judged.text.find("Overall exposure level");
    if (at == std::string::npos)
      GTEST_SKIP() << "systemd-analyze security does not judge files offline here: " << judged.text;
    std::printf("[ EXPOSURE ] %s", judged.text.substr(at).c_str());
    EXPECT_EQ(judged.code, 0) << "above 3.0\n" << judged.text;
  }
}

/// Copies a unit with its example for recordings to a folder of their own. @return the folder
fs::path unit_with_recordings(const std::string& program) {
  const fs::path folder = fs::path{TANDEM_BINARY_DIR} / "unit-recordings",
                 source = fs::path{TANDEM_SOURCE_DIR} / "server/package";
  const fs::path more = folder / (program + ".service.d");
  fs::create_directories(more);
  for (const auto& [from, to] : {std::pair{source / (program + ".service"), folder / (program + ".service")},
                                 std::pair{source / (program + "-recordings.conf"), more / "recordings.conf"}})
    EXPECT_EQ(shell("sed 's|/usr/bin/" + program + "|" + (fs::path{TANDEM_BINARY_DIR} / "bin" / program).string() +
                    "|' " + quoted(from) + " > " + quoted(to))
                  .code,
              0);
  return folder;
}

// The sandbox with recordings: the console may write into their folder, and only there.
TEST(DebianPackages, ContainExamplesOfUnitsWithRecordings) {
  if (!there("systemd-analyze")) GTEST_SKIP() << kNoSystemd;
  for (const std::string program : {"tandem-server", "tandem-console"}) {
    const fs::path folder = unit_with_recordings(program);
    const std::string unit = quoted(folder / (program + ".service"));
    const Done accepted = shell("systemd-analyze verify --man=no " + unit);
    EXPECT_EQ(accepted.code, 0) << accepted.text;
    EXPECT_EQ(accepted.text.find(program + ".service"), std::string::npos) << accepted.text;
    EXPECT_EQ(accepted.text.find("recordings.conf"), std::string::npos) << accepted.text;
    const Done judged = shell("systemd-analyze security --offline=true --threshold=30 " + unit);
    if (judged.text.find("Overall exposure level") == std::string::npos)
      GTEST_SKIP() << "systemd-analyze security does not judge files offline here: " << judged.text;
    EXPECT_EQ(judged.code, 0) << "above 3.0\n" << judged.text;
  }
}

// Checks the installed units, except that their programs are those of this build.
TEST(DebianPackages, ContainUnitsThatSystemdAccepts) {
  if (!there("systemd-analyze")) GTEST_SKIP() << kNoSystemd;
  for (const std::string program : {"tandem-server", "tandem-console"}) {
    const fs::path unit = fs::path{TANDEM_BINARY_DIR} / "unit" / (program + ".service");
    fs::create_directories(unit.parent_path());
    ASSERT_EQ(
        shell("sed 's|/usr/bin/" + program + "|" + (fs::path{TANDEM_BINARY_DIR} / "bin" / program).string() + "|' " +
              quoted(fs::path{TANDEM_SOURCE_DIR} / "server/package" / (program + ".service")) + " > " + quoted(unit))
            .code,
        0);
    const Done judged = shell("systemd-analyze verify --man=no " + quoted(unit));
    EXPECT_EQ(judged.code, 0) << judged.text;
    EXPECT_EQ(judged.text.find(program + ".service"), std::string::npos) << "unknown words or values\n" << judged.text;
  }
}

/// Tests the service under a separate systemd. In `root` the packages are installed, and `tandem-server init` was run.
/// @param why_not  set to the reason if no systemd can be started here
void run_as_a_service(const fs::path& root, std::string& why_not) {
  const auto not_run = [&](const std::string& why) { why_not = why; };
  const std::string in = "chroot " + quoted(root) + " ";
  if (!there("unshare") || !there("nsenter") || !there("ip")) return not_run("needs unshare, nsenter and ip");
  const Done installed = shell(
      in +
      "sh -c 'export DEBIAN_FRONTEND=noninteractive; apt-get install -y -qq --no-install-recommends systemd dbus'");
  ASSERT_EQ(installed.code, 0) << installed.text;
  Process booted({"/bin/sh", (fs::path{TANDEM_SOURCE_DIR} / "tests/install/boot_systemd").string(), root.string()});
  std::string first, state;
  for (int i = 0; i < 120 && state != "running" && state != "degraded"; ++i) {
    shell("sleep 0.5");
    first = shell("pgrep -P " + std::to_string(booted.id()) + " | tr -d '\\n'").text;
    if (first.empty()) continue;
    state = shell("nsenter -a -t " + first + " -r -w systemctl is-system-running | tr -d '\\n'").text;
  }
  if (state != "running" && state != "degraded") return not_run("no systemd boots in namespaces here: " + state);
  const std::string there = "nsenter -a -t " + first + " -r -w ";
  const auto show = [&](const std::string& property) {
    return shell(there + "systemctl show --value -p " + property + " tandem-server | tr -d '\\n'").text;
  };
  const auto becomes = [&](const std::string& property, const std::string& value) {
    for (int i = 0; i < 120 && show(property) != value; ++i) shell("sleep 0.25");
    return show(property) == value;
  };
  // No workstation is enrolled and the address is loopback: the service runs. `start` succeeds only after the server
  // reports that it is ready (Type=notify).
  const Done started = shell(there + "systemctl start tandem-server");
  EXPECT_EQ(started.code, 0) << started.text << shell(there + "systemctl status --no-pager tandem-server").text;
  EXPECT_EQ(show("SubState"), "running");
  EXPECT_EQ(shell(there + "awk '/^Uid:/ {print $2}' /proc/" + show("MainPID") + "/status").text,
            shell(in + "id -u tandem").text)
      << "its own user";
  EXPECT_EQ(shell(there + "runuser -u tandem -- tandem-server sessions").code, 0);
  // Ticks notify systemd's watchdog: the server survives several watchdog periods of 2 s.
  const std::string pid = show("MainPID");
  shell("sleep 6");
  EXPECT_EQ(show("MainPID"), pid);
  // systemd restarts a killed server.
  shell(there + "systemctl kill -s KILL tandem-server");
  EXPECT_TRUE(becomes("NRestarts", "1"));
  EXPECT_TRUE(becomes("SubState", "running"));
  EXPECT_NE(show("MainPID"), pid);
  // An upgrade restarts a running server; a stopped server stays stopped.
  const std::string before_upgrade = show("MainPID"),
                    upgrade = there + "sh -c 'DEBIAN_FRONTEND=noninteractive dpkg --install /opt/tandem-server_*.deb'";
  const Done upgraded = shell(upgrade);
  EXPECT_EQ(upgraded.code, 0) << upgraded.text;
  EXPECT_TRUE(becomes("SubState", "running"));
  EXPECT_NE(show("MainPID"), before_upgrade);
  EXPECT_EQ(shell(there + "systemctl stop tandem-server").code, 0);
  EXPECT_EQ(show("Result"), "success");
  const Done again = shell(upgrade);
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_NE(show("SubState"), "running");
  // systemd does not restart a server that ended because of a wrong configuration.
  shell(in + "sh -c 'cp /etc/tandem/server.textproto /tmp/right; echo nonsense >> /etc/tandem/server.textproto'");
  EXPECT_NE(shell(there + "systemctl start tandem-server").code, 0);
  EXPECT_TRUE(becomes("SubState", "failed"));
  EXPECT_EQ(show("ExecMainStatus"), "2");
  EXPECT_EQ(show("NRestarts"), "0");
  shell(in + "cp /tmp/right /etc/tandem/server.textproto");
  if (!::testing::Test::HasFailure())
    std::printf(
        "[ SERVICE  ] ran under systemd: ready, watched, restarted after a kill and by an upgrade, stopped, a wrong "
        "configuration not tried again\n");
}

TEST(DebianPackages, InstallOnAFreshDebian) {
  const char* counts = std::getenv("TANDEM_COUNTS");
  if (counts == nullptr || std::string_view{counts} == "reduced")
    GTEST_SKIP() << "minutes of installing belong to ./test --full (TANDEM_COUNTS=full)";
  if (::getuid() != 0) GTEST_SKIP() << "needs root";
  if (!there("debootstrap")) GTEST_SKIP() << "debootstrap is not installed (./test --full installs it)";
  if (const std::string& why = packages(); !why.empty()) GTEST_SKIP() << why;
  const fs::path root = kPlace / "debian";
  // The mirror that this machine uses.
  const std::string mirror =
      shell("apt-get indextargets --format '$(SITE)' 2>/dev/null | grep -v security | head -n 1 | tr -d '\\n'").text;
  if (mirror.empty()) GTEST_SKIP() << "apt knows no mirror";
  const Done made = shell("debootstrap --variant=minbase bookworm " + quoted(root) + " " + mirror);
  if (made.code != 0)
    GTEST_SKIP() << "debootstrap failed: " << made.text.substr(made.text.size() > 300 ? made.text.size() - 300 : 0);
  // /opt, because the systemd that boots there empties /tmp.
  ASSERT_EQ(
      shell("cp " + quoted(kPlace) + "/tandem-[!d]*.deb " + quoted(root) + "/opt/ && cp /etc/apt/sources.list.d/* " +
            quoted(root) + "/etc/apt/sources.list.d/ 2>/dev/null; cp /etc/apt/apt.conf.d/* " + quoted(root) +
            "/etc/apt/apt.conf.d/ 2>/dev/null; true")
          .code,
      0);
  const std::string in = "chroot " + quoted(root) + " ";
  const Done installed = shell(in +
                               "sh -c 'export DEBIAN_FRONTEND=noninteractive; apt-get -qq update; apt-get install -y "
                               "-qq --no-install-recommends /opt/*.deb'");
  ASSERT_EQ(installed.code, 0) << installed.text;
  for (const std::string name : {"tandem-server", "tandem-client", "tandem-netsim", "tandem-console"})
    EXPECT_EQ(shell(in + name + " --version").code, 0) << name;
  EXPECT_EQ(shell(in + "stat -c '%U %a' /var/lib/tandem").text, "tandem 700\n");
  const Done init = shell(
      in + "su -s /bin/sh tandem -c 'tandem-server init && tandem-server serve /etc/tandem/server.textproto --check'");
  EXPECT_EQ(init.code, 0) << init.text;
  const Done session = shell(in + "tandem-netsim run one_axis --duration 1");
  EXPECT_EQ(session.code, 0) << session.text;
  std::string why_no_service;
  run_as_a_service(root, why_no_service);
  const Done purged = shell(in +
                            "sh -c 'apt-get purge -y -qq tandem-server && test ! -e /var/lib/tandem && test ! -e "
                            "/etc/tandem/server.textproto'");
  EXPECT_EQ(purged.code, 0) << purged.text;
  fs::remove_all(root);
  if (!why_no_service.empty()) GTEST_SKIP() << "all but the service under systemd: " << why_no_service;
}

}  // namespace
}  // namespace tandem::test
