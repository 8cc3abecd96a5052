#pragma once

#include <string_view>

/// Style sheet of the drawings, for a page with several drawings and for a file with one. Line colours are Okabe and
/// Ito's palette, which colour-blind readers can distinguish. Lines of one panel also differ in width and dashes, so
/// that they differ in a grey print. Dark mode changes the variables only.
namespace tandem::netsim::plot {

inline constexpr std::string_view kPlotColours = R"css(
:root { color-scheme: light dark; --bg: #fff; --fg: #1c2128; --soft: #57606a; --rule: #d0d7de; --grid: #e7eaee; --panel: #f6f8fa;
  --trainer: #0072b2; --trainee: #d55e00; --slave: #9aa4ae; --third: #009e73; --mark: #8250df; --band: #f0e442; --band-strength: .28;
  --met: #1a7f37; --missed: #cf222e; }
@media (prefers-color-scheme: dark) { :root { --bg: #0d1117; --fg: #e6edf3; --soft: #9198a1; --rule: #3d444d; --grid: #21262d;
  --panel: #151b23; --trainer: #56b4e9; --trainee: #ff9d3c; --slave: #707a85; --third: #2bc99a; --mark: #b794f6; --band: #f0e442;
  --band-strength: .13; --met: #3fb950; --missed: #ff7b72; } }
)css";

inline constexpr std::string_view kPlotRules = R"css(
svg.figure { display: block; width: 100%; height: auto; } svg text { font: 12px system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; fill: var(--fg); }
svg .tick { fill: var(--soft); font-size: 11px; } svg .mid { text-anchor: middle; } svg .end { text-anchor: end; }
svg .title { font-weight: 600; } svg .legend { font-size: 13px; }
svg .note { font-size: 11.5px; paint-order: stroke; stroke: var(--bg); stroke-width: 3.5px; stroke-linejoin: round; }
svg .grid { stroke: var(--grid); } svg .frame { fill: none; stroke: var(--rule); } svg .dot { fill: var(--mark); stroke: var(--bg); stroke-width: 1.5; }
svg .mark { stroke: var(--mark); stroke-dasharray: 2 3; stroke-width: 1.3; } svg .band { fill: var(--band); fill-opacity: var(--band-strength); }
svg .line { fill: none; stroke-linejoin: round; stroke-linecap: butt; stroke-width: 1.5; }
svg .slave { stroke: var(--slave); stroke-width: 4.2; stroke-opacity: .75; } svg .trainer { stroke: var(--trainer); }
svg .trainee { stroke: var(--trainee); stroke-dasharray: 6 2.5; } svg .alpha, svg .first { stroke: var(--trainer); }
svg .second { stroke: var(--trainee); stroke-dasharray: 7 3; } svg .third { stroke: var(--third); stroke-dasharray: 2.5 2.5; stroke-width: 2; }
svg .box { fill: var(--panel); stroke: var(--rule); } svg .cloud { stroke-dasharray: 4 3; } svg .wall { fill: var(--grid); stroke: var(--soft); }
svg .wire { stroke: var(--soft); } svg .tip.trainer { fill: var(--trainer); } svg .tip.trainee { fill: var(--trainee); } svg .tip.slave { fill: var(--slave); }
svg .series0 { stroke: var(--trainer); stroke-width: 2.6; } svg .series1 { stroke: var(--trainee); } svg .series2 { stroke: var(--third); }
svg .series3 { stroke: var(--mark); } svg .series4 { stroke: var(--trainee); stroke-dasharray: 7 3; } svg .series5 { stroke: var(--soft); stroke-dasharray: 2.5 2.5; }
svg .series6 { stroke: var(--third); stroke-dasharray: 7 3; } svg .series7 { stroke: var(--mark); stroke-dasharray: 2.5 2.5; }
svg .rug { fill: var(--missed); } svg .up { stroke: var(--trainer); stroke-width: 1.1; } svg .down { stroke: var(--trainee); stroke-width: 1.1; }
)css";

}  // namespace tandem::netsim::plot
