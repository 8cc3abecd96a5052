// Output to a closed pipe, as in `tandem-netsim profiles | head -1`: programs that only print end silently, and
// sessions continue.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "common/io/fd.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

struct End {
  int code = -1;  ///< exit code, or minus the signal number
  std::string err;
};

/// Runs a program whose standard output is a closed pipe.
/// @param ignored  true: SIGPIPE is ignored, as under a service manager or in a script with a trap
/// @param err_too  true: standard error is a closed pipe too
End into_closed_pipe(Words command, bool ignored, bool err_too = false) {
  std::array<int, 2> out{}, err{};
  EXPECT_EQ(pipe2(out.data(), O_CLOEXEC), 0);
  EXPECT_EQ(pipe2(err.data(), O_CLOEXEC), 0);
  const io::Fd write_end{out[1]}, read_err{err[0]};
  close(out[0]);
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    ::signal(SIGPIPE, ignored ? SIG_IGN : SIG_DFL);
    dup2(out[1], STDOUT_FILENO);
    dup2(err_too ? out[1] : err[1], STDERR_FILENO);
    execv(words.front(), words.data());
    _exit(127);
  }
  close(err[1]);
  End end;
  std::array<char, 4096> bytes;
  for (ssize_t got = 0; (got = read(read_err.get(), bytes.data(), bytes.size())) > 0;)
    end.err.append(bytes.data(), static_cast<std::size_t>(got));
  int status = 0;
  waitpid(pid, &status, 0);
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return end;
}

TEST(ClosedPipe, EndsPrintingProgramsWithoutAMessage) {
  const Folder folder;
  const std::vector<Words> printing{{TANDEM_NETSIM, "profiles"},
                                    {TANDEM_NETSIM, "profiles", "lan"},
                                    {TANDEM_NETSIM, "--help"},
                                    {TANDEM_NETSIM, "run", "--help"},
                                    {TANDEM_NETSIM, "run", "one_axis", "--duration", "2"},
                                    {TANDEM_NETSIM, "run", "one_axis", "--duration", "2", "--json", "-"},
                                    {TANDEM_NETSIM, "run", "one_axis", "--check"},
                                    {TANDEM_SERVER, "scenes"},
                                    {TANDEM_SERVER, "scenes", "--print", "lesson"},
                                    {TANDEM_SERVER, "--help"},
                                    {TANDEM_SERVER, "--version"},
                                    {TANDEM_SERVER, "run", "lesson", "--check"},
                                    {TANDEM_CLIENT, "--help"},
                                    {TANDEM_CLIENT, "join", "--help"},
                                    {TANDEM_CLIENT, "doctor"},
                                    {TANDEM_DEMO, "--help"}};
  for (const Words& command : printing)
    for (const bool ignored : {false, true}) {
      SCOPED_TRACE(testing::PrintToString(command) + (ignored ? " ignoring SIGPIPE" : ""));
      const End end = into_closed_pipe(command, ignored);
      const bool nothing_found =
          command.back() == "doctor" && end.code == 1;  // doctor exits with 1 on a computer without devices
      EXPECT_TRUE(end.code == 0 || end.code == -SIGPIPE || nothing_found) << end.code;
      EXPECT_EQ(end.err.find("standard output"), std::string::npos) << end.err;
      EXPECT_EQ(end.err.find("tandem-"), std::string::npos) << "a program complains: " << end.err;
    }
}

TEST(ClosedPipe, EndsNeitherAServerNorASeat) {
  const Folder folder;
  for (const bool ignored : {false, true}) {
    Process host = hosting("one_axis", {"--duration", "3"});
    const std::string report = folder.file("report.json");
    const End hand = into_closed_pipe(
        {TANDEM_CLIENT, "join", "--server", address_of(host), "--seat", "trainer", "--device", "sim", "--json", report},
        ignored, true);
    EXPECT_EQ(hand.code, 0);
    EXPECT_EQ(folder.json("report.json")["ended_by"], "done") << folder.read("report.json");
    EXPECT_EQ(host.wait(), 0) << host.err();
  }
  const End server =
      into_closed_pipe({TANDEM_SERVER, "run", "one_axis", "--duration", "1", "--start-timeout", "1"}, false, true);
  EXPECT_GE(server.code, 0) << "it ends by itself, as no client joined, and by no signal";
}

}  // namespace
}  // namespace tandem::test
