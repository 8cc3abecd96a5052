#include "common/io/program.h"

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/nearest.h"

namespace tandem::io {

int run_program(CLI::App& app, const std::function<int()>& action, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 does not say which word it did not know when a command is missing.
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (!word.empty() && !word.starts_with('-') && app.get_subcommands().empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      std::fprintf(stderr, "%s: no command is called \"%s\"; %s\n", app.get_name().c_str(), argv[1], suggest(word, known).c_str());
      return 2;
    }
    // Help and version are ends, not mistakes; every mistake in arguments is 2, whatever CLI11 calls it.
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return action();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return 1;
  }
}

}  // namespace tandem::io
