#pragma once

namespace tandem::io {

/// Exit codes of all programs.
inline constexpr int kExitDone = 0;
inline constexpr int kExitTrouble = 1;        ///< an error while running, a verdict "fail", or an interrupted judgement
inline constexpr int kExitUsage = 2;          ///< wrong arguments or files; nothing was started
inline constexpr int kExitInterrupted = 130;  ///< tandem-demo only: 128 + SIGINT, as shells do

}  // namespace tandem::io
