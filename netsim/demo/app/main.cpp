#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "common/io/command_line.h"
#include "common/io/print.h"
#include "netsim/demo/app/child_process.h"
#include "netsim/demo/app/run_demo.h"

#ifndef TANDEM_VERSION
#define TANDEM_VERSION "unknown"
#endif

namespace {

using tandem::netsim::demo::run_plans;
using tandem::netsim::demo::RunPlan;

/// Returns the runs named in "a,b,c", in the order in which they run. Empty: all.
std::vector<const RunPlan*> chosen_runs(const std::string& list, std::string& mistakes) {
  std::vector<std::string> names;
  std::istringstream words(list);
  for (std::string name; std::getline(words, name, ',');) names.push_back(name);
  std::string known;
  for (const RunPlan& plan : run_plans()) known += (known.empty() ? "" : ", ") + std::string(plan.name);
  for (const std::string& name : names)
    if (std::ranges::none_of(run_plans(), [&](const RunPlan& p) { return p.name == name; }))
      mistakes += "--runs: \"" + name + "\" is none of " + known + "\n";
  std::vector<const RunPlan*> runs;
  for (const RunPlan& plan : run_plans())
    if (names.empty() || std::ranges::find(names, plan.name) != names.end()) runs.push_back(&plan);
  return runs;
}

/// Options that ./demo adds itself.
bool added_by_script(const std::string& word) { return word == "--live" || word == "--console"; }

}  // namespace

int main(int argc, char** argv) {
  tandem::netsim::demo::DemoOptions plan;
  std::string list;
  bool live = false;
  const auto action = [&] {
    std::string mistakes;
    plan.runs = chosen_runs(list, mistakes);
    if (!mistakes.empty()) {
      tandem::io::print(stderr, mistakes);
      return 2;
    }
    plan.version = TANDEM_VERSION;
    plan.repeat = tandem::netsim::demo::command_text([&] {
      std::vector<std::string> words{"./demo"};
      for (int i = 1; i < argc; ++i)
        if (!added_by_script(argv[i])) words.emplace_back(argv[i]);
      return words;
    }());
    return tandem::netsim::demo::run_demo(plan);
  };
  tandem::io::Program program(
      "tandem-demo", TANDEM_VERSION,
      "tandem-demo repeats the two experiments of Licona et al. (ICVARS 2019) with a real server, two real clients "
      "with\n"
      "simulated devices and the network simulator between them, all over UDP on this machine; prints the paper's "
      "numbers\n"
      "beside ours and draws the paper's figures 6 to 12 into report.html.",
      action);
  const tandem::io::Command root = program.root();
  root.add_flag("--live", live, "all runs in real time, about two minutes; default of ./demo");
  root.add_flag("--quick", plan.quick, "virtual time: the same runs in one process, in seconds, without sockets");
  root.add_option(
          "--runs", list,
          "only these, separated by commas: seed_free_motion, free_motion, free_motion_bad, seed_contact, contact,\n"
          "contact_bad; default: all, in this order")
      .value_name("LIST");
  root.add_option("--out", plan.out,
                  "folder for report.html, traces, JSON reports and logs; default: report.html here, the rest in "
                  "./demo-output,\n"
                  "which is removed at the end")
      .value_name("DIR");
  root.add_flag("--console", plan.console, "tandem-console beside the live runs: a picture of them in a browser");
  root.add_flag("--keep", plan.keep, "leaves ./demo-output (10 MB per run)");
  root.footer(
      "In real time the six runs take about two minutes. Late ticks and gate trips that a busy machine causes are "
      "counted\n"
      "and shown, never a failure.\n"
      "Exit: 0 done, 1 trouble (a program fails, a promised invariant is broken), 2 wrong arguments, 130 "
      "interrupted.\n\n"
      "Examples\n"
      "  tandem-demo --live\n"
      "  tandem-demo --quick --out /tmp/demo\n"
      "  tandem-demo --runs free_motion,free_motion_bad --keep");
  // Without arguments the program prints its help, because the experiments take two minutes.
  return program.run(argc > 1 ? std::vector<std::string>{argv + 1, argv + argc} : std::vector<std::string>{"--help"});
}
