// The help of every command of the real programs: valid examples, groups, lines that fit the terminal.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/io/programs.h"
#include "tests/support/terminal.h"

namespace tandem::test {
namespace {

struct Program {
  const char* path;
  const char* name;
};
constexpr Program kPrograms[] = {{TANDEM_SERVER, "tandem-server"},
                                 {TANDEM_CLIENT, "tandem-client"},
                                 {TANDEM_NETSIM, "tandem-netsim"},
                                 {TANDEM_CONSOLE, "tandem-console"},
                                 {TANDEM_DEMO, "tandem-demo"}};

const std::string& help_of(const Program& program, const std::string& command) {
  static std::map<std::string, std::string> known;
  std::string& help = known[program.name + (" " + command)];
  if (!help.empty()) return help;
  Words words{program.path};
  if (!command.empty()) words.push_back(command);
  words.push_back("--help");
  Process process(words);
  EXPECT_EQ(process.wait(), 0) << process.err();
  return help = process.out();
}

/// Returns the names under "Subcommands:".
Words commands_of(const std::string& help) {
  Words commands;
  std::istringstream lines(help.substr(std::min(help.size(), help.find("Subcommands:"))));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  "))
    if (line[2] != ' ') commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  return commands;
}

/// Returns the commands under "Examples", each joined to one line.
Words examples_of(const std::string& help) {
  Words examples;
  const auto at = help.find("\nExamples\n");
  if (at == std::string::npos) return examples;
  std::istringstream lines(help.substr(at + 10));
  std::string line, whole;
  while (std::getline(lines, line) && line.starts_with("  ")) {
    const bool more = line.ends_with(" \\");
    whole += line.substr(0, line.size() - (more ? 2 : 0));
    if (more) continue;
    examples.push_back(whole.substr(whole.find_first_not_of(' ')));
    whole.clear();
  }
  return examples;
}

/// Whether the program does something without a command, too.
bool runs_alone(const std::string& program) { return program == "tandem-demo" || program == "tandem-console"; }

Words words_of(const std::string& line) {
  std::istringstream in(line);
  Words words;
  for (std::string word; in >> word && word != "#" && word != ">" && word != "<";) words.push_back(word);
  return words;
}

/// Returns the error of an example; empty if its program, command and options exist.
std::string wrong_with(const std::string& example) {
  Words words = words_of(example);
  if (!words.empty() && words.front() == "sudo") words.erase(words.begin());
  if (words.size() > 1 && words.front() == "$(which" && words[1].ends_with(')')) {  // sudo has a path of its own
    words.erase(words.begin());
    words.front().pop_back();
  }
  if (words.empty()) return "no command";
  const auto program = std::ranges::find(kPrograms, words.front(), &Program::name);
  if (program == std::end(kPrograms)) return words.front() + " is no program of ours";
  const Words commands = commands_of(help_of(*program, ""));
  std::string command;
  if (!commands.empty()) {
    const bool known = words.size() > 1 && std::ranges::find(commands, words[1]) != commands.end();
    const bool option = words.size() < 2 || words[1].starts_with("--");
    if (!known && !(option && runs_alone(words.front()))) return "no such command";
    if (known) command = words[1];
  }
  const std::string help = help_of(*program, command);
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    const std::string option = word.substr(0, word.find('='));
    bool whole = false;
    for (auto at = help.find(option); at != std::string::npos && !whole; at = help.find(option, at + 1))
      whole = help.find_first_of(" ,\n=", at) == at + option.size();
    if (!whole) return option + " is no option of it";
  }
  return {};
}

TEST(Help, HasTwoValidExamplesForEveryCommand) {
  for (const Program& program : kPrograms) {
    const std::string top = help_of(program, "");
    Words commands = commands_of(top);
    const std::string name = program.name;
    EXPECT_TRUE(!commands.empty() || runs_alone(name)) << top;
    if (runs_alone(name)) commands.emplace_back();
    for (const std::string& command : commands) {
      SCOPED_TRACE(std::string(program.name) + " " + command);
      const std::string help = help_of(program, command);
      const Words examples = examples_of(help);
      EXPECT_GE(examples.size(), 2u) << help;
      for (const std::string& example : examples) EXPECT_EQ(wrong_with(example), "") << example;
    }
  }
}

/// The help contains no words that readers must guess at, and no reference to an option that is not shown beside it.
TEST(Help, UsesPlainWords) {
  for (const Program& program : kPrograms) {
    Words commands = commands_of(help_of(program, ""));
    commands.emplace_back();
    for (const std::string& command : commands) {
      std::string help = " " + help_of(program, command);
      std::ranges::replace(help, '\n', ' ');
      for (const char* word : {" puck", "entitled", "  the same, or a recording"})
        EXPECT_EQ(help.find(word), std::string::npos) << program.name << " " << command << ": " << word;
    }
  }
}

TEST(Help, DetectsInvalidExamples) {
  EXPECT_EQ(wrong_with("tandem-client join --server 127.0.0.1:7000 --saet trainer"), "--saet is no option of it");
  EXPECT_EQ(wrong_with("tandem-client jion --server 127.0.0.1:7000"), "no such command");
  EXPECT_EQ(wrong_with("tandem-cleint join"), "tandem-cleint is no program of ours");
}

TEST(Help, IsGroupedAndWrappedToTheTerminal) {
  for (const std::size_t columns : {80u, 100u, 120u, 200u}) {
    TerminalProcess help({TANDEM_CLIENT, "join", "--help"}, columns, 200);
    EXPECT_EQ(help.wait(), 0);
    EXPECT_TRUE(help.terminal().wraps().empty()) << columns << ": " << help.terminal().wraps().front();
    const std::string text = flat(help.terminal().all());
    const auto needed = text.find("Needed:"), where = text.find("Connection:"), output = text.find("Output:"),
               own = text.find("Help:");
    EXPECT_LT(needed, where) << text;
    EXPECT_LT(where, output) << text;
    EXPECT_LT(output, own) << text;
    EXPECT_LT(own, text.find("Examples")) << text;
  }
}

TEST(Demo, PrintsItsHelpWithoutArguments) {
  Process demo({TANDEM_DEMO});
  EXPECT_EQ(demo.wait(), 0) << demo.err();
  EXPECT_NE(demo.out().find("Usage: "), std::string::npos) << demo.out();
  EXPECT_NE(demo.out().find("--live"), std::string::npos) << demo.out();
}

TEST(Units, AreAcceptedByEveryOptionWithAFixedUnit) {
  Process run({TANDEM_NETSIM, "run", "one_axis", "--delay", "20ms", "--loss", "5%", "--duration", "2s", "--outage",
               "1s,0.1s", "--quiet", "--json", "-"});
  EXPECT_EQ(run.wait(), 0) << run.err();
  Process wrong({TANDEM_NETSIM, "run", "one_axis", "--delay", "20s"});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_NE(wrong.err().find("the unit is ms"), std::string::npos) << wrong.err();
  for (const Words& words : {Words{TANDEM_SERVER, "run", "one_axis", "--duration", "5ms", "--check"},
                             Words{TANDEM_CLIENT, "join", "--server", "127.0.0.1:1", "--seat", "a", "--device", "sim",
                                   "--reconnect-timeout", "5ms"},
                             Words{TANDEM_CLIENT, "link-test", "--server", "127.0.0.1:1", "--duration", "5%"},
                             Words{TANDEM_NETSIM, "sweep", "one_axis", "--delay", "5%"}}) {
    Process process(words);
    EXPECT_EQ(process.wait(), 2) << words[1];
    EXPECT_NE(process.err().find(words[1] == "sweep" ? " ms " : "the unit is s"), std::string::npos) << process.err();
  }
  Process good({TANDEM_SERVER, "run", "one_axis", "--duration", "5s", "--start-timeout", "2 s", "--check"});
  EXPECT_EQ(good.wait(), 0) << good.err();
}

/// Returns the first letter of each description in a table of a help text.
std::string first_letters(const std::string& help, const std::string& heading) {
  std::string letters;
  std::istringstream text(help.substr(std::min(help.find(heading), help.size())));
  std::string line;
  for (std::getline(text, line); std::getline(text, line) && !line.empty();) {
    const std::size_t gap = line.find("  ", 2),
                      words = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
    if (line.starts_with("  ") && line[2] != ' ' && words != std::string::npos) letters += line[words];
  }
  return letters;
}

/// Commands are described by sentences, options by phrases in lower case.
TEST(Help, HasOneFormatInEveryProgram) {
  for (const std::string program : {TANDEM_SERVER, TANDEM_CLIENT, TANDEM_NETSIM, TANDEM_DEMO}) {
    Process help({program, "--help"});
    EXPECT_EQ(help.wait(), 0);
    const std::string commands = first_letters(help.out(), "\nSubcommands:"),
                      ends = first_letters(help.out(), "\nHelp:");
    EXPECT_EQ(commands.empty(), program == TANDEM_DEMO) << help.out();
    EXPECT_TRUE(std::ranges::all_of(commands, [](char c) { return c >= 'A' && c <= 'Z'; })) << commands << help.out();
    EXPECT_EQ(ends.size(), 2u) << help.out();
    EXPECT_TRUE(std::ranges::all_of(ends, [](char c) { return c >= 'a' && c <= 'z'; })) << ends << help.out();
  }
}

TEST(Check, ReportsSuccessInItsLastLine) {
  const Folder folder;
  const std::string config =
      folder.write("s.textproto", "version: 1 listen: \"127.0.0.1:0\" session { name: \"a\" scene: \"contact\" }");
  for (const Words& words :
       {Words{TANDEM_SERVER, "run", "lesson", "--check"}, Words{TANDEM_SERVER, "serve", config, "--check"},
        Words{TANDEM_NETSIM, "run", "contact", "--check"}, Words{TANDEM_NETSIM, "test", "contact-delay", "--check"}}) {
    Process check(words);
    EXPECT_EQ(check.wait(), 0) << check.err();
    const std::size_t last = check.out().rfind("\n# OK: ");
    ASSERT_NE(last, std::string::npos) << words[1] << check.out();
    EXPECT_EQ(check.out().find('\n', last + 1), check.out().size() - 1) << "the last line";
  }
}

TEST(FullDisk, IsReportedForEveryFileOfARun) {
  for (const char* option : {"--json", "--trace", "--log"}) {
    Process run({TANDEM_NETSIM, "run", "one_axis", "--duration", "2", option, "/dev/full"});
    EXPECT_EQ(run.wait(), 1) << option;
    EXPECT_NE(run.err().find("/dev/full could not be written to the end: the disk is full"), std::string::npos)
        << option << run.err();
  }
  Process sweep({TANDEM_NETSIM, "sweep", "one_axis", "--delay", "0", "--duration", "2", "--csv", "/dev/full"});
  EXPECT_EQ(sweep.wait(), 1);
  EXPECT_NE(sweep.err().find("the disk is full"), std::string::npos) << sweep.err();
}

TEST(Scene, ReportsACsvTableInOneLine) {
  const Folder folder;
  std::string table = "t_s[s],x[m],y[m]\n";
  for (int i = 0; i < 200; ++i) table += std::to_string(i) + ",0.1,0.2\n";
  const std::string file = folder.write("motion.csv", table);
  Process run({TANDEM_SERVER, "run", file, "--check"});
  EXPECT_EQ(run.wait(), 2);
  EXPECT_NE(run.err().find("is a CSV table, not a scene"), std::string::npos) << run.err();
  EXPECT_LE(std::ranges::count(run.err(), '\n'), 2) << run.err();
  const std::string large = folder.write("large.csv", [&] {
    std::string text;
    while (text.size() < (2U << 20)) text += table;
    return text;
  }());
  Process again({TANDEM_NETSIM, "run", large});
  EXPECT_EQ(again.wait(), 2);
  EXPECT_NE(again.err().find("is a CSV table, not a scene"), std::string::npos)
      << "however long it is: " << again.err();
}

TEST(Remedies, NameTheStateFolderAndNoInitForLoopback) {
  const Folder folder;
  const std::string missing = folder.file("none");
  Process sessions({TANDEM_SERVER, "sessions", "--state", missing});
  EXPECT_EQ(sessions.wait(), 1);
  EXPECT_NE(sessions.err().find("there is no state folder " + missing), std::string::npos) << sessions.err();
  EXPECT_NE(sessions.err().find("A server on loopback that was started without --state has no folder"),
            std::string::npos)
      << sessions.err();
  EXPECT_NE(sessions.err().find("tandem-server init --state " + missing), std::string::npos) << sessions.err();
  Process init({TANDEM_SERVER, "init", "--state", missing});
  EXPECT_EQ(init.wait(), 0) << init.err();
  EXPECT_NE(init.err().find("tandem-server enroll NAME --address HOST:PORT --state " + missing), std::string::npos)
      << init.err();
  Process run({TANDEM_SERVER, "run", "one_axis", "--listen", "0.0.0.0:0", "--state", missing});
  EXPECT_EQ(run.wait(), 2);
  EXPECT_NE(run.err().find("tandem-server enroll --state " + missing + " NAME"), std::string::npos) << run.err();
  Process join(
      {TANDEM_CLIENT, "join", "--server", "127.0.0.1:1", "--seat", "a", "--device", "sim", "--timeout", "0.2s"});
  EXPECT_EQ(join.wait(), 1);
  EXPECT_NE(join.err().find("`tandem-server run free_motion --listen 127.0.0.1:1`"), std::string::npos) << join.err();
}

}  // namespace
}  // namespace tandem::test
